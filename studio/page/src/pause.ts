// Waiting.
export const pause = (ms: number) => new Promise<void>(resolve => setTimeout(resolve, ms));

/** When what has changed by now is drawn; a page that nobody looks at draws nothing. */
export const nextPicture = () => new Promise<void>(resolve => (document.hidden ? resolve() : requestAnimationFrame(() => setTimeout(resolve))));
