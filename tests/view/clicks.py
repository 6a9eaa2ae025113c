"""Opens a page of `oriel view` in Chromium, clicks, and compares the panel with what `oriel explain` says.

clicks.py ORIEL CHROMIUM SAMPLE WORK [PICTURE]
"""
import json
import os
import subprocess
import sys

from browser import Browser

CANVAS = "document.querySelector('#scene canvas')"
MOST_BYTES = 1_000_000  # of a page of one house
LEAST_PICTURE_BYTES = 40_000  # of a screenshot: an empty scene takes half


def oriel(*arguments):
    return subprocess.run([ORIEL, *arguments], check=True, capture_output=True, text=True).stdout


def check(is_true, what):
    print("ok  " if is_true else "FAIL", what)
    if not is_true:
        failures.append(what)


def text_of(browser, selector):
    return browser.value(f"document.querySelector({json.dumps(selector)})?.textContent ?? ''")


def settle(browser):
    """Until what was asked for is drawn."""
    browser.value("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 150))))")


def find(browser, feature):
    browser.value("document.querySelector('#search').value = ''")
    browser.click_on("#search")
    browser.type(feature)
    browser.press("Enter")
    settle(browser)
    browser.value("document.activeElement.blur()")
    settle(browser)


def forget(browser):
    browser.press("Escape")
    settle(browser)


# Where what the picture looks at is drawn: the middle of what nothing lies over, beside the legend or over it.
MIDDLE = """(() => {
  const all = document.querySelector('#scene').getBoundingClientRect();
  const top = document.querySelector('#scene .tool-bar')?.getBoundingClientRect().bottom ?? all.top;
  const card = document.querySelector('#scene .legend-card')?.getBoundingClientRect();
  const free = (left, bottom) => ({left, width: all.right - left, top, height: Math.max(0.2 * all.height, bottom - top)});
  const beside = free(card?.width ? card.right : all.left, all.bottom), over = free(all.left, card?.width ? card.top : all.bottom);
  const side = area => Math.min(area.width, area.height);
  const area = side(beside) >= side(over) ? beside : over;
  return [area.left + area.width / 2, area.top + area.height / 2];
})()"""


def click_middle(browser):
    browser.click(*browser.value(MIDDLE))
    settle(browser)


def rules_of(browser, selector):
    return browser.value(f"[...document.querySelectorAll('{selector} .rule')].map(r => r.dataset.rule)")


def open_others(browser):
    browser.value("document.querySelectorAll('#whynot .others').forEach(box => { box.open = true; })")
    settle(browser)


def check_feature(browser, record):
    """Finds a feature by its id, forgets it, clicks where it is, and reads why it is called so."""
    identity, label = record["id"], record["label"] or "unknown"
    find(browser, identity[:9])
    check(text_of(browser, "#chosen") == label, f"search finds the {label} {identity}")
    forget(browser)
    check(text_of(browser, "#chosen") == "", "Escape forgets it")
    find(browser, record["name"].replace(",", "").upper())
    check(text_of(browser, "#name") == record["name"], f"search finds {record['name']} in capitals and without commas")
    forget(browser)
    click_middle(browser)
    check(text_of(browser, "#chosen") == label, f"a click on the {label} shows it")
    explained = oriel("explain", SAMPLE, identity, "--full")
    check(text_of(browser, "#head") == explained.splitlines()[0], "with the verdict that explain gives")
    sentence = text_of(browser, "#sentence")
    check(" m " in sentence and " in a " in sentence or " on a " in sentence, f"and a plain sentence: {sentence}")
    open_others(browser)
    said = json.loads(oriel("explain", SAMPLE, identity, "--json"))
    rules = rules_of(browser, "#why") + rules_of(browser, "#whynot")
    check(sorted(rules) == sorted(rule["id"] for rule in said["rules"]), "every rule says why or why not")
    check(said["rule"] in rules_of(browser, "#why"), f"{said['rule']} is why")
    cells = browser.value("[...document.querySelectorAll('.condition')].map(c => c.dataset.found)")
    missing = [c["value"] for rule in said["rules"] for c in rule["require"] if "value" in c and c["value"] not in cells]
    check(not missing, f"with all values that explain found {missing[:3] or ''}")


def main():
    browser = Browser(CHROMIUM, width=1200, height=675)
    try:
        page = os.path.join(WORK, "page.html")
        records = os.path.join(WORK, "parts.json")
        small = os.path.join(WORK, "small.city.json")
        oriel("label", SAMPLE, "--features", records)
        oriel("generalise", SAMPLE, "--scale", "1:2500", "-o", small)
        oriel("view", SAMPLE, "--after", small, "-o", page)
        house = os.path.join(WORK, "house.html")
        oriel("view", SAMPLE, "-o", house)
        with open(records) as file:
            features = {r["label"]: r for r in sorted(json.load(file), key=lambda r: r["id"], reverse=True)}
        browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-reduced-motion", "value": "reduce"}])
        browser.open("file://" + house)
        check(browser.value(f"{CANVAS} !== null"), "the page draws with WebGL")
        picture = os.path.join(WORK, "first.png")
        browser.screenshot(picture)
        check(os.path.getsize(picture) > LEAST_PICTURE_BYTES, "the building is seen")
        for label in ("window", "door", "chimney", "dormer", "balcony"):
            check_feature(browser, features[label])
        forget(browser)
        click_middle(browser)
        browser.click_on(".crumb:nth-child(2)")
        settle(browser)
        check(text_of(browser, "#chosen") in ("Wall", "Roof") and "says so" in text_of(browser, ".why-line"), "a surface says why it is one")
        find(browser, features["dormer"]["id"])
        click_middle(browser)
        crumbs = browser.value("[...document.querySelectorAll('.crumb')].map(c => c.textContent)")
        check("dormer" in crumbs, f"what a part lies in stands over it: {crumbs}")
        find(browser, "nothing")
        check("Nothing is called 'nothing'" in text_of(browser, ".status"), "a name that is not there is told")
        browser.open("file://" + page)
        count = browser.value("document.querySelectorAll('.picture').length")
        check(count == 2, "before and after are two pictures")
        browser.value("document.querySelector('.divider').focus()")
        browser.press("ArrowLeft")
        check(browser.value("document.querySelector('.divider').getAttribute('aria-valuenow')") == "48", "whose line arrow keys move")
        calls = int(browser.value("document.querySelector('#scene').dataset.drawCalls"))
        check(0 < calls <= 8, f"a house takes {calls} draw calls")
        if PICTURE:
            browser.open("file://" + house)
            find(browser, features["door"]["id"])
            browser.value("document.body.dispatchEvent(new KeyboardEvent('keydown', {key: '1', bubbles: true}))")
            settle(browser)
            browser.screenshot(PICTURE)
        size = os.path.getsize(house)
        check(size <= MOST_BYTES, f"a page of a house has {size} bytes")
        browser.open("file://" + page + "#" + features["chimney"]["id"])
        settle(browser)
        check(text_of(browser, "#chosen") == "chimney", "an id behind # opens the page there")
        asked = [a for a in browser.requests if not a.startswith(("file://" + page, "file://" + house, "about:"))]
        check(not asked, f"the page asks for nothing else {asked or ''}")
        check(not browser.complaints, f"and complains about nothing {browser.complaints or ''}")
    finally:
        browser.close()
    sys.exit(1 if failures else 0)


failures = []
ORIEL, CHROMIUM, SAMPLE, WORK = sys.argv[1:5]
PICTURE = sys.argv[5] if len(sys.argv) > 5 else None
main()
