// Elements are made here and nowhere from text: what comes from data is always text, never markup.
type Member = string | number | boolean | EventListener | ((event: any) => void) | Record<string, string> | null | undefined;
type Child = Node | string | null | undefined | false;

/** el('button', {class: 'x', onclick: …, 'aria-label': '…', style: {width: '3px'}}, 'text', child …) */
export function el<K extends keyof HTMLElementTagNameMap>(name: K, members: Record<string, Member> = {}, ...children: Child[]):
    HTMLElementTagNameMap[K] {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(members)) apply(element, key, value);
  element.append(...children.filter((child): child is Node | string => child !== null && child !== undefined && child !== false));
  return element;
}

export function svg(name: string, members: Record<string, string | number> = {}, ...children: Element[]): SVGElement {
  const element = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(members)) element.setAttribute(key, String(value));
  element.append(...children);
  return element;
}

function apply(element: HTMLElement, key: string, value: Member): void {
  if (value === null || value === undefined || value === false) return;
  if (typeof value === 'function') element.addEventListener(key.replace(/^on/, ''), value as EventListener);
  else if (key === 'style') for (const [name, text] of Object.entries(value as Record<string, string>)) element.style.setProperty(name, text);
  else if (key === 'class') element.className = String(value);
  else if (key === 'value' && 'value' in element) element.value = String(value);
  else element.setAttribute(key, value === true ? '' : String(value));
}

/** Replaces what is in an element only where the new text differs: a list that is redrawn keeps its focus and its place. */
export function replace(element: Element, ...children: Child[]): void {
  element.replaceChildren(...children.filter((child): child is Node | string => child !== null && child !== undefined && child !== false));
}
