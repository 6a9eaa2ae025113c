"""Opens a page of `oriel view` in Chromium, clicks, and compares the panel with what `oriel explain` says.

clicks.py ORIEL CHROMIUM SAMPLE WORK [PICTURE]
"""
import json
import os
import subprocess
import sys

from browser import Browser

CANVAS = "document.querySelector('#scene canvas')"


def oriel(*arguments):
    return subprocess.run([ORIEL, *arguments], check=True, capture_output=True, text=True).stdout


def check(is_true, what):
    print("ok  " if is_true else "FAIL", what)
    if not is_true:
        failures.append(what)


def text_of(browser, selector):
    return browser.value(f"document.querySelector({json.dumps(selector)})?.textContent ?? ''")


def find(browser, feature):
    browser.value("document.querySelector('input').value = ''")
    browser.click_on("input")
    browser.type(feature)
    browser.press("Enter")


def click_middle(browser):
    browser.click_on("#scene canvas")


def rules_of(browser, selector):
    return browser.value(f"[...document.querySelectorAll('{selector} summary code')].map(c => c.textContent)")


def check_feature(browser, record):
    """Finds a feature by its id, forgets it, clicks where it is, and reads why it is called so."""
    identity, label = record["id"], record["label"] or "unknown"
    find(browser, identity[:9])
    check(text_of(browser, "#chosen") == label, f"search finds the {label} {identity}")
    browser.press("Escape")
    check(text_of(browser, "#chosen") == "", "Escape forgets it")
    find(browser, record["name"].replace(",", "").upper())
    check(text_of(browser, "#name") == record["name"], f"search finds {record['name']} in capitals and without commas")
    browser.press("Escape")
    click_middle(browser)
    check(text_of(browser, "#chosen") == label, f"a click on the {label} shows it")
    explained = oriel("explain", SAMPLE, identity, "--full")
    check(text_of(browser, "#head") == explained.splitlines()[0], "with the verdict that explain gives")
    said = json.loads(oriel("explain", SAMPLE, identity, "--json"))
    rules = rules_of(browser, "#why") + rules_of(browser, "#whynot")
    check(sorted(rules) == sorted(rule["id"] for rule in said["rules"]), "every rule says why or why not")
    check(said["rule"] in rules_of(browser, "#why"), f"{said['rule']} is why")
    cells = browser.value("[...document.querySelectorAll('#panel td')].map(d => d.textContent)")
    missing = [c["value"] for rule in said["rules"] for c in rule["require"] if "value" in c and c["value"] not in cells]
    check(not missing, f"with all values that explain found {missing or ''}")


def main():
    browser = Browser(CHROMIUM, width=1200, height=675)
    try:
        page = os.path.join(WORK, "page.html")
        records = os.path.join(WORK, "parts.json")
        small = os.path.join(WORK, "small.city.json")
        oriel("label", SAMPLE, "--features", records)
        oriel("generalise", SAMPLE, "--scale", "1:2500", "-o", small)
        oriel("view", SAMPLE, "--after", small, "-o", page)
        with open(records) as file:
            features = {r["label"]: r for r in sorted(json.load(file), key=lambda r: r["id"], reverse=True)}
        browser.open("file://" + page)
        check(browser.value(f"{CANVAS} !== null"), "the page draws with WebGL")
        colours = browser.value(f"""(c => {{ const d = document.createElement('canvas'); d.width = c.width; d.height = c.height;
          const x = d.getContext('2d'); x.drawImage(c, 0, 0); const p = x.getImageData(0, 0, d.width, d.height).data;
          const seen = new Set(); for (let i = 0; i < p.length; i += 4) seen.add(p[i] << 16 | p[i + 1] << 8 | p[i + 2]);
          return seen.size; }})({CANVAS})""")
        check(colours > 10, f"the building is seen, in {colours} colours")
        for label in ("window", "door", "chimney", "dormer", "balcony"):
            check_feature(browser, features[label])
        browser.press("Escape")
        click_middle(browser)
        browser.click_on("#owners button:last-child")
        check(text_of(browser, "#chosen").endswith("Surface") and " by " in text_of(browser, "#why"),
              "a surface says why it is one")
        browser.open("file://" + page)
        width, height = browser.value(f"[{CANVAS}.clientWidth, {CANVAS}.clientHeight]")
        browser.click(0.435 * width, 0.38 * height)
        check(text_of(browser, "#chosen") == "window", "a click on the dormer's window in the view of the whole house shows it")
        if PICTURE:
            browser.screenshot(PICTURE)
        browser.click_on("#owners button:nth-child(2)")
        check(text_of(browser, "#chosen") == "dormer", "and that it lies in a dormer")
        find(browser, "nothing")
        check(text_of(browser, "#chosen") == "no id and no name begins with 'nothing'", "an id that is not there is told")
        before = text_of(browser, "#legend")
        browser.click_on("#models button:last-child")
        check(text_of(browser, "#legend") not in ("", before), f"after: {text_of(browser, '#legend')}")
        browser.click_on("#models button:first-child")
        check(text_of(browser, "#legend") == before, "and before again")
        browser.open("file://" + page + "#" + features["chimney"]["id"])
        check(text_of(browser, "#chosen") == "chimney", "an id behind # opens the page there")
        asked = [a for a in browser.requests if not a.startswith(("file://" + page, "about:"))]
        check(not asked, f"the page asks for nothing else {asked or ''}")
        check(not browser.complaints, f"and complains about nothing {browser.complaints or ''}")
    finally:
        browser.close()
    sys.exit(1 if failures else 0)


failures = []
ORIEL, CHROMIUM, SAMPLE, WORK = sys.argv[1:5]
PICTURE = sys.argv[5] if len(sys.argv) > 5 else None
main()
