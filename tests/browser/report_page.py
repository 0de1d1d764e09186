"""Tests the report pages in a browser on made-up results. Usage: report_page.py NODE PAGE_FOLDER PLACE

Node writes a page for each kind of result. Each page is opened on a screen and on a phone, light and dark.
"""
import base64
import csv
import io
import os
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

from chromium import Browser

SVG = "{http://www.w3.org/2000/svg}"

# Clicks all buttons with this label and returns the saved files as [name, base64].
SAVED = """
  const files = [];
  HTMLAnchorElement.prototype.click = function () {
    files.push((async () => {
      const bytes = new Uint8Array(await (await fetch(this.href)).arrayBuffer());
      return [this.download, btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""))];
    })());
  };
  const buttons = [...document.querySelectorAll("button.save")].filter((button) => button.textContent === args[0]);
  for (const button of buttons) button.click();
  while (files.length < buttons.length) await new Promise((done) => setTimeout(done, 20));
  return Promise.all(files);
"""


def check(holds, what):
    if not holds:
        raise AssertionError(what)


def saved(browser, label):
    return [(name, base64.b64decode(content)) for name, content in browser.wait(SAVED, label)]


def downloads_are_well_formed(browser, kind):
    figures, tables = browser.run("return ['figure', 'details.table'].map((kind) => document.querySelectorAll(kind).length)")
    pictures = saved(browser, "SVG")
    check(len(pictures) == figures, f"{kind}: {len(pictures)} SVG files of {figures} plots")
    for name, content in pictures:
        svg = ElementTree.fromstring(content)
        check(svg.tag == SVG + "svg" and float(svg.get("width")) > 200 and float(svg.get("height")) > 100, f"{kind}: {name} is no drawing")
        check(any(text.text for text in svg.iter(SVG + "text")), f"{kind}: {name} has no text")
        numbers = [value for part in svg.iter() for value in part.attrib.values()]
        check(not any("NaN" in value for value in numbers), f"{kind}: {name} has coordinates that are no numbers")
    for name, content in saved(browser, "PNG"):
        check(content.startswith(b"\x89PNG") and len(content) > 2000, f"{kind}: {name} is no picture")
    files = saved(browser, "CSV")
    check(len(files) == figures + tables, f"{kind}: {len(files)} CSV files")
    for name, content in files:
        lines = list(csv.reader(io.StringIO(content.decode())))
        check(len(lines) > 1 and len({len(line) for line in lines}) == 1, f"{kind}: {name} is no table")
        check(len(set(lines[0])) == len(lines[0]) and all(lines[0]), f"{kind}: {name} has the heads {lines[0]}")
    for name, content in saved(browser, "LaTeX"):
        text = content.decode()
        check(text.startswith("\\begin{tabular}{") and text.endswith("\\end{tabular}\n"), f"{kind}: {name} is no tabular")
        columns = len(text.split("{")[2].split("}")[0])
        body = text.split("\n", 1)[1].rsplit("\\bottomrule", 1)[0]
        for row in body.replace("\\toprule\n", "").replace("\\midrule\n", "").strip().split("\n"):
            cells = row.replace("\\&", "")
            check(row.endswith("\\\\") and cells.count("&") == columns - 1, f"{kind}: {name} has the row {row}")


def answers(browser, kind):
    answer = browser.run("return document.getElementById('answer').textContent")
    check(len(answer) > 30 and "undefined" not in answer and "NaN" not in answer, f"{kind}: the answer is '{answer}'")
    text = browser.run("return document.getElementById('report').textContent")
    for wrong in ("undefined", "NaN", "[object"):
        check(wrong not in text, f"{kind}: the page says '{wrong}'")
    check(browser.run("return document.getElementById('answer').getBoundingClientRect().bottom < 400"), f"{kind}: the answer is low")
    check("How it was made" in text, f"{kind}: the page does not say how it was made")


def tables_sort_and_filter(browser):
    """The first table of contacts: sorted by occupancy at first, then by the column that is clicked."""
    browser.run("document.querySelector('details.table').open = true")
    column = "return [...document.querySelectorAll('details.table')[0].querySelectorAll('tbody tr')].map((row) => row.cells[arguments[0]].textContent)"
    click = "[...document.querySelectorAll('details.table')[0].querySelectorAll('th button')].find((b) => b.textContent === arguments[0]).click()"
    check(browser.run(column, 5) == ["2", "90"], "contacts are not sorted by occupancy")
    browser.run(click, "contacts")
    check(browser.run(column, 5) == ["90", "2"], "a click on a heading does not sort downward")
    browser.run(click, "contacts")
    check(browser.run(column, 5) == ["2", "90"], "a second click on a heading does not sort upward")
    check(browser.run("return document.querySelectorAll('th[aria-sort=ascending]').length") == 1, "no heading says how the rows are sorted")
    check(browser.run(column, 1)[0] == "<b>&_5", "a name is read as HTML")


def large_tables_are_paged(browser):
    """Of 500 rows 50 are shown, and a typed name finds its row."""
    state = """const table = document.querySelector('details.table');
        return [table.querySelectorAll('tbody tr').length, table.querySelector('[role=status]').textContent]"""
    browser.run("document.querySelector('details.table').open = true")
    check(browser.run(state) == [50, "50 of 500 rows shown."], f"a large table shows {browser.run(state)}")
    browser.driver.find_element("css selector", "details.table input").send_keys("leu 499")
    check(browser.run(state) == [1, "1 of 500 rows shown; the text is in 1."], f"a filter shows {browser.run(state)}")


def main(node, page, place):
    os.makedirs(place, exist_ok=True)
    tests = os.path.join(page, "tests")
    subprocess.run([node, os.path.join(tests, "sample_results.mjs"), place], check=True)
    kinds = sorted(name[:-5] for name in os.listdir(place) if name.endswith(".json"))
    check({"contacts", "contacts_many", "missed", "compare", "run", "trade", "collide", "sweep", "info"} <= set(kinds), f"only {kinds}")
    for kind in kinds:
        subprocess.run([node, os.path.join(tests, "make_report.mjs"), os.path.join(page, "dist", "report_page.html"),
                        os.path.join(place, kind + ".json"), os.path.join(place, kind + ".html"), "replay.html"], check=True)
    for dark in (False, True):
        with Browser(dark=dark) as browser:
            for kind in kinds:
                browser.size(1280, 800)
                browser.open(os.path.join(place, kind + ".html"))
                answers(browser, kind)
                check(browser.run("return document.querySelector('header a').getAttribute('href')") == "replay.html", "no link to the replay")
                if not dark:
                    browser.run("for (const part of document.querySelectorAll('details')) part.open = true")
                    downloads_are_well_formed(browser, kind)
                browser.size(390, 844)
                browser.wait("await new Promise((done) => setTimeout(done, 150))")
                check(browser.run("return document.documentElement.scrollWidth") <= 390, f"{kind} is wider than a phone")
            browser.open(os.path.join(place, "contacts.html"))
            tables_sort_and_filter(browser)
            browser.open(os.path.join(place, "contacts_many.html"))
            large_tables_are_paged(browser)
            complaints, requests = browser.complaints(), browser.requests()
            check(not complaints, f"the pages complain: {complaints}")
            check(not requests, f"the pages ask the network: {requests}")
            print("passed:", "dark" if dark else "light", *kinds)
    with Browser() as browser:
        browser.driver.get("file://" + os.path.abspath(os.path.join(page, "dist", "report_page.html")))
        text = browser.wait("await kds.ready.catch(() => 0); return document.getElementById('problem').textContent")
        check("no result" in text, f"a page without a result says '{text}'")
    print("passed")


if __name__ == "__main__":
    main(*sys.argv[1:])
