"""Tests what a reader finds, measures and saves in a replay page. Usage: replay_look.py NODE PAGE_FOLDER PLACE

Node writes a made-up replay of two chains with 4 residues of 3 beads each.
"""
import base64
import io
import math
import os
import struct
import subprocess
import sys
import zipfile

from chromium import Browser
from replay_page import check, click, pixels
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

MAP_LEFT, MAP_BOTTOM = 52, 20  # pixels of the map's axes

# Clicks an element and returns what the page saves: [name, type, bytes].
SAVED = """return new Promise((done) => {
    HTMLAnchorElement.prototype.click = async function () {
      const bytes = new Uint8Array(await (await fetch(this.href)).arrayBuffer());
      const blob = await (await fetch(this.href)).blob();
      let text = "";
      for (let k = 0; k < bytes.length; k += 8192) text += String.fromCharCode(...bytes.subarray(k, k + 8192));
      done([this.download, blob.type, btoa(text)]);
    };
    document.getElementById(args[0]).click();
  })"""

# The box of a kind of contacts.
KIND_SWITCH = "[...document.querySelectorAll('.chip')].find((chip) => chip.textContent.startsWith(arguments[0])).querySelector('input')"


def saved(browser, button):
    name, kind, text = browser.wait(SAVED, button)
    return name, kind, base64.b64decode(text)


def choose(browser, **values):
    for name, value in values.items():
        browser.run("""const e = document.getElementById(arguments[0]);
            if (typeof arguments[1] === "boolean") e.checked = arguments[1]; else e.value = arguments[1];
            for (const kind of ["input", "change"]) e.dispatchEvent(new Event(kind));""", name.replace("_", "-"), value)


def heading(browser):
    return browser.run("return document.querySelector('#bead h3')?.textContent ?? ''")


def find(browser, text):
    box = browser.driver.find_element("id", "find")
    box.clear()
    box.send_keys(text + Keys.ENTER)
    browser.wait("await new Promise((done) => setTimeout(done, 100))")


def place_of(browser, bead):
    """Returns where a bead is seen, in pixels of the page."""
    return browser.run("""const r = document.getElementById("scene").getBoundingClientRect(), [x, y] = kds.project(arguments[0]);
        return [r.left + x, r.top + y, r.left + r.width / 2, r.top + r.height / 2]""", bead)


def search_finds_a_residue(browser):
    find(browser, "B ALA 2")
    check(heading(browser) == "16 B/ALA2/CA", f"the search chose '{heading(browser)}'")
    x, y, middle, height = place_of(browser, 16)
    check(abs(x - middle) < 1 and abs(y - height) < 60, "the found bead is not in the middle")
    find(browser, "ALA 3")
    first = heading(browser)
    browser.driver.find_element("id", "find").send_keys(Keys.ENTER)
    check((first, heading(browser)) == ("7 A/ALA3/CA", "19 B/ALA3/CA"), "Enter does not go to the next residue of a name")
    find(browser, "LEU 99")
    check("LEU 99" in browser.run("return document.getElementById('found').textContent"), "a name that is not there is not said")
    find(browser, "")
    browser.run("document.getElementById('reset-camera').click(); document.getElementById('find').blur()")


def names_are_under_the_pointer(browser):
    choose(browser, bead_size=1)
    browser.wait("await kds.seek(3, 0.4)")
    for bead in range(24):
        x, y, *_ = place_of(browser, bead)
        if browser.run("return kds.pick(...arguments)", int(x), int(y)) == bead:
            break
    actions = ActionChains(browser.driver)
    actions.w3c_actions.pointer_action.move_to_location(int(x), int(y))
    actions.perform()
    text = browser.run("const t = document.getElementById('tip'); return t.hidden ? '' : t.textContent")
    check(text.endswith(f"bead {bead}") and " ALA " in text, f"the pointer on bead {bead} says '{text}'")


def map_goes_to_the_next_event(browser):
    """The twin goes through all events of contacts, one after another."""
    browser.run("document.querySelectorAll('.row-label > label:first-child input').forEach((box, k) => { if (k < 2) box.click(); })")
    browser.wait("await kds.seek(2, 0.5)")
    body = browser.driver.find_element("tag name", "body")
    body.send_keys(Keys.ESCAPE)
    now = """return [kds.state().step + kds.state().u,
        [...document.querySelectorAll("#event .bead")].map((button) => parseInt(button.textContent))]"""
    events = []
    for _ in range(30):
        body.send_keys("n")
        time, beads = browser.wait("await new Promise((done) => setTimeout(done, 30));" + now)
        if events and events[-1][0] == time:
            break
        events.append((time, sorted({bead // 3 for bead in beads})))
    pairs = [pair for _, pair in events if len(pair) == 2]
    pair = max(pairs, key=pairs.count)
    left, top, width, height = browser.run(
        "const r = document.getElementById('map').getBoundingClientRect(); return [r.left, r.top, r.width, r.height]")
    square = min(width - MAP_LEFT, height - MAP_BOTTOM) / 8
    browser.wait("await kds.seek(2, 0.5)")
    for expected in [time for time, other in events if other == pair][:3]:
        click(browser, left + MAP_LEFT + (pair[1] + 0.5) * square, top + (pair[0] + 0.5) * square)
        time, beads = browser.wait("await new Promise((done) => setTimeout(done, 150));" + now)
        check(sorted({bead // 3 for bead in beads}) == pair, f"a click on {pair} chose an event of beads {beads}")
        check(time == expected, f"the next event is at {expected}, the map went to {time}")
    text = browser.run("return document.getElementById('map-text').textContent")
    check(f"ALA {pair[0] % 4 + 1} – " in text and "% of the run" in text, f"the map says '{text}'")
    browser.run(KIND_SWITCH + ".click()", "begin")
    for _ in range(3):
        click(browser, left + MAP_LEFT + (pair[1] + 0.5) * square, top + (pair[0] + 0.5) * square)
        browser.wait("await new Promise((done) => setTimeout(done, 150))")
        kind = browser.run("return document.querySelector('#event h3').textContent")
        check(kind == "contacts: end", f"the map went to {kind}, though begin is off")
    browser.run(KIND_SWITCH + ".click()", "begin")


def distances_are_true(browser):
    find(browser, "bead 5")
    browser.run("document.getElementById('reset-camera').click()")
    browser.wait("await kds.seek(3, 0.4)")
    seen = ((bead, *place_of(browser, bead)[:2]) for bead in range(23, 5, -1))
    bead, x, y = next(one for one in seen if browser.run("return kds.pick(...arguments)", int(one[1]), int(one[2])) == one[0])
    browser.run("document.getElementById('measure').click()")
    click(browser, x, y)
    for time in ((3, 0.4), (6, 0.75)):
        browser.wait("await kds.seek(...args)", *time)
        positions = browser.run("return [...kds.state().positions]")
        true = math.dist(positions[15:18], positions[3 * bead:3 * bead + 3])
        text = browser.run("return [document.querySelector('#distance b').textContent, document.getElementById('distance-label').textContent]")
        check(all(abs(float(one.split()[0]) - true) <= 0.00051 for one in text), f"beads 5 and {bead} are {true} apart, shown {text}")
    check(heading(browser).startswith("5 "), "the second bead was chosen instead of measured")


def png_size(data):
    check(data[:8] == b"\x89PNG\r\n\x1a\n", "no PNG")
    return struct.unpack(">II", data[16:24])


def pictures_have_their_size(browser):
    size = browser.run("const c = document.getElementById('scene'); return [c.clientWidth, c.clientHeight]")
    for times in (1, 4):
        choose(browser, png_scale=str(times), png_texts=True, png_transparent=False)
        name, kind, data = saved(browser, "png")
        check(name.endswith(".png") and kind == "image/png", f"saved {name}, {kind}")
        check(list(png_size(data)) == [times * side for side in size], f"{times} times {size} gave {png_size(data)}")
    alpha = """const image = new Image();
        image.src = "data:image/png;base64," + args[0];
        await image.decode();
        const c = new OffscreenCanvas(image.width, image.height), g = c.getContext("2d");
        g.drawImage(image, 0, 0);
        const {data} = g.getImageData(0, 0, c.width, c.height);
        return [data[3], data.filter((v, k) => k % 4 === 3 && v === 255).length]"""
    check(browser.wait(alpha, base64.b64encode(data).decode())[0] == 255, "the page's colour is missing")
    choose(browser, png_scale="1", png_texts=False, png_transparent=True)
    corner, opaque = browser.wait(alpha, base64.b64encode(saved(browser, "png")[2]).decode())
    check(corner == 0 and opaque > 500, f"transparent: alpha {corner} in the corner, {opaque} opaque pixels")
    choose(browser, png_texts=True, png_transparent=False)


def films_are_written(browser):
    browser.size(700, 560)  # small films are made sooner
    choose(browser, film_seconds="0.2", film_type="zip", film_span="run")
    before = browser.run("return kds.state().step + kds.state().u")
    name, _, data = saved(browser, "film")
    archive = zipfile.ZipFile(io.BytesIO(data))
    check(archive.testzip() is None and len(archive.namelist()) == 5, f"{name} has {archive.namelist()}")
    frames = [archive.read(frame) for frame in archive.namelist()]
    check(len({png_size(frame) for frame in frames}) == 1 and len(set(frames)) == 5, "the frames do not differ")
    browser.wait("while (document.getElementById('film').textContent === 'Stop') await new Promise((done) => setTimeout(done, 100))")
    check(browser.run("return kds.state().step + kds.state().u") == before, "the film does not come back to the present")
    if browser.run("return document.querySelector('#film-type option').disabled"):
        return browser.size(1280, 800)
    choose(browser, film_type="webm")
    name, kind, data = saved(browser, "film")
    check(name.endswith((".webm", ".mp4")) and kind.startswith("video/") and len(data) > 1000, f"saved {name}, {kind}, {len(data)} bytes")
    size = browser.wait("""const video = document.createElement("video");
        video.src = `data:${args[1]};base64,${args[0]}`;
        await new Promise((done, failed) => { video.onloadeddata = done; video.onerror = failed; });
        return [video.videoWidth, video.videoHeight]""", base64.b64encode(data).decode(), kind.split(";")[0])
    check(tuple(size) == png_size(frames[0]), f"the film is {size} large")
    browser.size(1280, 800)


def copied(browser):
    """Returns the copied link and the scene, both at rest."""
    browser.run("document.getElementById('copy-link').click()")
    browser.wait("await new Promise((done) => setTimeout(done, 300))")
    return browser.run("return document.getElementById('link-text').value")


def link_restores_what_is_seen(browser, replay):
    choose(browser, colour="life", lines="10", bead_size=0.45, map_measure="changes")
    browser.driver.find_element("tag name", "body").send_keys("+")
    browser.wait("await kds.seekEvent(2, 3)")
    pixels_of = lambda: pixels(browser, "beads", "trace", "contacts")
    browser.run(KIND_SWITCH + ".click()", "end")
    picture = pixels_of()
    browser.wait("await kds.seekEvent(2, 3)")  # pixels_of releases the event
    link = copied(browser)
    parts = dict(part.split("=") for part in link.split("#")[1].split("&"))
    for name in ("s", "u", "e", "b", "layers", "cam", "colour", "lines", "size", "map", "dist", "off", "pair"):
        check(name in parts, f"the link does not say {name}: {link}")
    browser.open(replay, "#" + link.split("#")[1])
    browser.wait("await new Promise((done) => setTimeout(done, 300))")
    check(copied(browser) == link, f"the link opens another view: {copied(browser)} from {link}")
    check(pixels_of() == picture, "the link shows another picture")
    check(not browser.run(f"return {KIND_SWITCH}.checked", "end"), "the link does not keep a kind switched off")
    # A page without an address: the copied state goes into the box that finds residues.
    # Choices that the state does not have are undone.
    browser.open(replay)
    browser.run("document.querySelector('.row:nth-child(3) input').click()")
    browser.wait("await kds.seek(2, 0)")
    browser.driver.find_element("tag name", "body").send_keys("[")
    browser.run("document.getElementById('zoom-in').click()")
    find(browser, "#" + link.split("#")[1])
    browser.wait("await new Promise((done) => setTimeout(done, 300))")
    check(copied(browser) == link, "the pasted state opens another view")


def event_is_in_sight_on_a_phone(browser):
    browser.size(390, 844)
    browser.wait("await kds.seekEvent(2, 4); await new Promise((done) => setTimeout(done, 300))")
    top, width = browser.run(
        "return [document.querySelector('#event h3').getBoundingClientRect().top, document.documentElement.scrollWidth]")
    check(0 < top < 700 and width <= 390, f"on a phone the event is at {top} of 844, the page {width} wide")


def main(node, page, place):
    os.makedirs(place, exist_ok=True)
    replay = os.path.join(place, "replay_look.html")
    subprocess.run([node, os.path.join(page, "tests", "make_replay.mjs"), os.path.join(page, "dist", "replay_page.html"), replay,
                    "24", "8", "3"], check=True)
    with Browser() as browser:
        browser.open(replay)
        for test in (search_finds_a_residue, names_are_under_the_pointer, map_goes_to_the_next_event, distances_are_true,
                     pictures_have_their_size, films_are_written):
            test(browser)
            print("passed:", test.__name__)
        link_restores_what_is_seen(browser, replay)
        event_is_in_sight_on_a_phone(browser)
        complaints, requests = browser.complaints(), browser.requests()
        check(not complaints, f"the page complains: {complaints}")
        check(not requests, f"the page asks the network: {requests}")
    print("passed")


if __name__ == "__main__":
    main(*sys.argv[1:])
