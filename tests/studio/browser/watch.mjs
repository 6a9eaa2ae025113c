// What a page did that it must not do.
export class Watch {
  complaints = [];
  strangers = [];

  /// `expected`: parts of what the console may say in this step.
  constructor(page, origin, expected) {
    const complain = text => { if (!expected.some(part => text.includes(part))) this.complaints.push(text); };
    page.on('console', message => {
      if (['error', 'warning'].includes(message.type()) && !isOfDriver(message.text()))
        complain(`${message.text()} (${message.location().url.replace(/\?.*/, '')})`);
    });
    page.on('pageerror', error => complain(error.message));
    page.on('request', request => {
      const url = request.url();
      if (!url.startsWith(origin) && !url.startsWith('data:') && !url.startsWith(`blob:${origin}`)) this.strangers.push(url);
    });
  }
}

/// Chromium warns of its own software renderer.
function isOfDriver(text) {
  return text.includes('GPU stall due to ReadPixels') || text.includes('GL Driver Message') || text.includes('swiftshader');
}
