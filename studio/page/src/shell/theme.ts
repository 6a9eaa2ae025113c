// Dark or light: what the reader has chosen here, else what the system says.
import type {Store} from '../store';

const kKey = 'oriel-theme';
const system = matchMedia('(prefers-color-scheme: dark)');

function chosen(): string | null {
  try { return localStorage.getItem(kKey); } catch { return null; }  // a page from a file may have no storage
}

function apply(store: Store): void {
  const theme = chosen() ?? (system.matches ? 'dark' : 'light');
  document.documentElement.dataset['theme'] = theme;
  store.set({is_dark: theme === 'dark'});
}

export function watchTheme(store: Store): void {
  apply(store);
  system.addEventListener('change', () => apply(store));
}

export function switchTheme(store: Store): void {
  const theme = store.value.is_dark ? 'light' : 'dark';
  try { localStorage.setItem(kKey, theme); } catch { /* holds for this page only */ }
  document.documentElement.dataset['theme'] = theme;
  store.set({is_dark: theme === 'dark'});
}
