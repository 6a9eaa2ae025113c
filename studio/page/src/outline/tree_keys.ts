// The keys of a tree, as the ARIA pattern asks: up and down move, right opens, left closes or goes to the parent, Enter chooses.

function visibleItems(tree: HTMLElement): HTMLElement[] {
  return [...tree.querySelectorAll<HTMLElement>('[role=treeitem]')];
}

function focusItem(tree: HTMLElement, item: HTMLElement | null | undefined): void {
  if (!item) return;
  for (const other of visibleItems(tree)) other.tabIndex = other === item ? 0 : -1;
  item.focus();
}

export function treeKeys(tree: HTMLElement, setOpen: (name: string, isOpen: boolean) => void): void {
  tree.addEventListener('keydown', event => {
    const item = (event.target as HTMLElement).closest<HTMLElement>('[role=treeitem]');
    if (!item) return;
    const items = visibleItems(tree);
    const at = items.indexOf(item);
    const expanded = item.getAttribute('aria-expanded');
    const moves: Record<string, () => void> = {
      ArrowDown: () => focusItem(tree, items[at + 1]),
      ArrowUp: () => focusItem(tree, items[at - 1]),
      Home: () => focusItem(tree, items[0]),
      End: () => focusItem(tree, items[items.length - 1]),
      ArrowRight: () => expanded === 'false' ? setOpen(item.dataset['name']!, true) : focusItem(tree, expanded === 'true' ? items[at + 1] : null),
      ArrowLeft: () => expanded === 'true' ? setOpen(item.dataset['name']!, false)
        : focusItem(tree, item.parentElement?.closest<HTMLElement>('[role=treeitem]')),
      Enter: () => item.querySelector<HTMLElement>('.tree-row')?.click(),
      ' ': () => item.querySelector<HTMLElement>('.tree-row')?.click()
    };
    const move = moves[event.key];
    if (!move) return;
    event.preventDefault();
    event.stopPropagation();
    move();
  });
}
