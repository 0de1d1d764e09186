"""Tests the replay page in a browser on a made-up replay. Usage: replay_page.py NODE PAGE_FOLDER PLACE

Node writes the replay. The picture is the twin of picking and of cages: the pixels say which bead is seen where.
"""
import base64
import itertools
import os
import random
import subprocess
import sys

from chromium import Browser
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

TITLE = "</script><script>kds.errors.push('ran')</script>"

# Draws some layers alone and returns the scene's pixels as rows of "#rrggbb".
PIXELS = """
  for (const box of document.querySelectorAll("#layers input"))
    if (box.checked !== args[0].includes(box.parentNode.textContent.trim())) box.click();
  const {step, u} = kds.state();
  await kds.seek(step, u);
  const scene = document.getElementById("scene");
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [scene.width, scene.height];
  const context = copy.getContext("2d");
  context.drawImage(scene, 0, 0);
  const {data} = context.getImageData(0, 0, copy.width, copy.height);
  const rows = [];
  for (let y = 0; y < copy.height; ++y) {
    const row = [];
    for (let x = 0; x < copy.width; ++x) row.push(data[4 * (y * copy.width + x)], data[4 * (y * copy.width + x) + 1], data[4 * (y * copy.width + x) + 2]);
    rows.push(btoa(String.fromCharCode(...row)));
  }
  return rows;
"""


def pixels(browser, *layers):
    rows = [base64.b64decode(row) for row in browser.wait(PIXELS, list(layers))]
    return [[tuple(row[k:k + 3]) for k in range(0, len(row), 3)] for row in rows]


def marked(picture):
    """Returns the places whose colour is not that of the page."""
    return {(x, y) for y, row in enumerate(picture) for x, colour in enumerate(row) if colour != picture[0][0]}


def check(holds, what):
    if not holds:
        raise AssertionError(what)


def click(browser, x, y):
    actions = ActionChains(browser.driver)
    actions.w3c_actions.pointer_action.move_to_location(int(x), int(y))
    actions.click().perform()


def state_of(browser):
    """Returns the state with its elements in one order."""
    return browser.run("""const s = kds.state();
        for (const name of ["edges", "contacts", "hidden", "cages"]) s[name] = s[name].map(String).sort();
        s.positions = [...s.positions]; return s;""")


def states_agree(browser):
    """Forward, backward and direct seeks give the same states."""
    rng = random.Random(1)
    times = sorted((rng.randrange(7), rng.random()) for _ in range(30))
    ways = [times, times[::-1], rng.sample(times, len(times))]
    seen = []
    for way in ways:
        states = {}
        for step, u in way:
            browser.wait("await kds.seek(...args)", step, u)
            state = state_of(browser)
            check(state["step"] == step and abs(state["u"] - u) < 1e-12, "the state is that of another time")
            states[step, u] = state
        seen.append(states)
    check(seen[0] == seen[1] == seen[2], "scrubbing forward, backward and seeking disagree")
    check(len({str(state["edges"]) for state in seen[0].values()}) > 10, "the edges hardly change")


def picking_agrees_with_pixels(browser):
    """Beads of the first necklace are blue, those of the second orange, and nothing else is drawn."""
    browser.wait("await kds.seek(3, 0.4)")
    picture = pixels(browser, "beads")
    place = browser.run("const r = document.getElementById('scene').getBoundingClientRect(); return [r.left, r.top]")
    spots = [(x, y) for y in range(2, len(picture), 9) for x in range(2, len(picture[0]), 9)]
    picked = browser.run("return arguments[0].map(([x, y]) => kds.pick(x + 0.5, y + 0.5))",
                         [[x + place[0], y + place[1]] for x, y in spots])
    shown = marked(picture)
    hits = []
    for (x, y), bead in zip(spots, picked):
        around = {(x + dx, y + dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1)}
        if shown & around and not around <= shown:
            continue  # the outline of a bead crosses the pixel
        check(((x, y) in shown) == (bead >= 0), f"pixel {x}, {y} and the picked bead {bead} disagree")
        if bead >= 0:
            colours = [picture[b][a] for a, b in around]
            if any(red > blue for red, _, blue in colours) == any(red < blue for red, _, blue in colours):
                continue  # beads of both necklaces meet here
            red, _, blue = picture[y][x]
            check((blue > red) == (bead < 12), f"pixel {x}, {y} has not the colour of bead {bead}")
            hits.append((x, y, bead))
    check(len(hits) > 20, f"only {len(hits)} beads were hit")
    x, y, bead = hits[len(hits) // 2]
    click(browser, x + place[0], y + place[1])
    check(browser.run("return document.querySelector('#bead h3').textContent").startswith(f"{bead} "), "the click chose another bead")


def cage_encloses_beads(browser):
    """The root's cage is a disc that covers all pixels of beads, and touches some of them."""
    browser.run("const l = document.getElementById('level'); l.value = 0; l.dispatchEvent(new Event('input'))")
    browser.run("const l = document.getElementById('bead-size'); l.value = 1; l.dispatchEvent(new Event('input'))")
    browser.driver.find_element("tag name", "body").send_keys(Keys.ESCAPE + "----")  # no ring, and the whole cage in sight
    for time in ((0, 0), (2, 0.63), (5, 0.9)):
        browser.wait("await kds.seek(...args)", *time)
        beads = marked(pixels(browser, "beads"))
        disc = marked(pixels(browser, "cages"))
        left, right = min(x for x, _ in disc), max(x for x, _ in disc)
        top, bottom = min(y for _, y in disc), max(y for _, y in disc)
        radius = (right - left) / 2
        check(radius > 50 and abs(radius - (bottom - top) / 2) < 1.5, "the cage is no disc")
        middle = (left + right) / 2, (top + bottom) / 2
        reach = max(((x - middle[0])**2 + (y - middle[1])**2)**0.5 for x, y in beads)
        check(reach < radius + 1.5, f"a bead sticks out of its cage: {reach} beyond {radius}")
        check(reach > 0.5 * radius, "the cage is far too large")


def keys_work(browser):
    body = browser.driver.find_element("tag name", "body")
    browser.wait("await kds.seek(0, 0)")
    orders = []
    for key in "nnnp":
        body.send_keys(key)
        browser.wait("await new Promise((done) => setTimeout(done, 30))")
        orders.append(browser.run("return kds.state().step + kds.state().u"))
    check(orders[0] < orders[1] < orders[2] and orders[3] == orders[1], f"n and p went to {orders}")
    check("event" in browser.run("return document.getElementById('event').textContent").lower(), "no event is shown")
    body.send_keys(" ")
    browser.wait("await new Promise((done) => setTimeout(done, 400))")
    body.send_keys(" ")
    check(browser.run("return kds.state().step + kds.state().u") > orders[3], "space did not play")
    views = []
    for key in ("", "+", Keys.SHIFT + Keys.ARROW_LEFT):
        body.send_keys(key)
        browser.wait("await new Promise((done) => setTimeout(done, 700))")
        views.append(browser.run("return new URLSearchParams(location.hash.slice(1)).get('cam')").split(","))
    check(float(views[1][6]) == 1.25 * float(views[0][6]), "plus does not zoom")
    check(views[2][:3] != views[1][:3] and views[2][3:] == views[1][3:], "shift and arrows do not turn the camera")
    cost = browser.run("return kds.statistics()")
    check(0 < cost["drawCalls"] <= 8, f"{cost['drawCalls']} draw calls")


def follows_a_bead(browser):
    """A followed bead stays in the middle of the scene, below the text, which takes 56 pixels."""
    browser.run("document.getElementById('reset-camera').click()")
    browser.wait("await kds.seek(1, 0)")
    left, top, width, height = browser.run(
        "const r = document.getElementById('scene').getBoundingClientRect(); return [r.left, r.top, r.width, r.height]")
    spots = [(left + x, top + y) for y in range(5, int(height), 7) for x in range(5, int(width), 7)]
    # All five places lie on one bead, so that a click, whose place is rounded, meets it too.
    around = [[(x, y), (x - 3, y), (x + 3, y), (x, y - 3), (x, y + 3)] for x, y in spots]
    picked = browser.run("return arguments[0].map((five) => five.map(([x, y]) => kds.pick(x, y)))", around)
    spot, bead = next((spot, five[0]) for spot, five in zip(spots, picked) if five[0] >= 0 and len(set(five)) == 1)
    click(browser, *spot)
    browser.driver.find_element("tag name", "body").send_keys("f")
    seen = [browser.wait("await kds.seek(args[0], 0.5); return kds.pick(args[1], args[2])", step, left + width / 2, top + height / 2 + 28)
            for step in range(7)]
    check(all(other >= 0 for other in seen), "nothing is in the middle")
    check(seen.count(bead) >= 4, f"bead {bead} is followed, and {seen} are in the middle")


def saves_a_picture(browser):
    saved = browser.wait("""return new Promise((done) => {
        HTMLAnchorElement.prototype.click = async function () {
          const blob = await (await fetch(this.href)).blob();
          done([this.download, blob.type, blob.size]);
        };
        document.getElementById("png").click();
      })""")
    check(saved[0].endswith(".png") and saved[1] == "image/png" and saved[2] > 1000, f"saved {saved}")


def loops(browser):
    body = browser.driver.find_element("tag name", "body")
    browser.wait("await kds.seek(2, 0)")
    body.send_keys("[")
    browser.wait("await kds.seek(2, 0.1)")
    body.send_keys("] ")
    times = []
    for _ in range(8):
        times.append(browser.wait("await new Promise((done) => setTimeout(done, 60)); return kds.state().step + kds.state().u"))
    body.send_keys(" \\")
    check(all(2 <= time <= 2.11 for time in times) and len(set(times)) > 2, f"the loop from 2 to 2.1 goes to {times}")
    check(browser.run("return document.getElementById('loop-shade').hidden"), "the loop is not cleared")


def timeline_goes_to_times(browser):
    """A click near a mark goes to its event, a click near the end of a contact's bar to its begin or end."""
    browser.run("document.getElementById('zoom-all').click()")
    # The places of drawn pixels in one row of a canvas, where they begin after a gap.
    starts = """const [selector, y] = arguments;
        const c = document.querySelector(selector), r = c.getBoundingClientRect();
        const {data} = c.getContext("2d").getImageData(0, y, c.width, 1);
        const found = [];
        for (let x = 8; x < c.width - 8; ++x) if (data[4 * x + 3] && !data[4 * x - 1]) found.push([r.left + x, r.top + y]);
        return found"""
    for selector, y, name in ((".row:nth-child(1) canvas", 20, "wrapped"), ("#pairs-canvas", 17, "contacts: begin")):
        x, y = browser.run(starts, selector, y)[0]
        click(browser, x, y)
        browser.wait("await new Promise((done) => setTimeout(done, 100))")
        shown = browser.run("return document.querySelector('#event h3')?.textContent ?? 'none'")
        check(shown.startswith(name), f"a click near a mark of {name} chose {shown}")
        head = browser.run("return document.getElementById('playhead').getBoundingClientRect().left")
        check(abs(head - x) < 6, f"the playhead is at {head}, the mark at {x}")
    actions = ActionChains(browser.driver)
    axis = browser.run("const r = document.getElementById('axis').getBoundingClientRect(); return [r.left, r.top + 5, r.width]")
    pointer = actions.w3c_actions.pointer_action
    pointer.move_to_location(int(axis[0] + 10), int(axis[1])).pointer_down()
    pointer.move_to_location(int(axis[0] + axis[2] / 2), int(axis[1])).pointer_up()
    actions.perform()
    browser.wait("await new Promise((done) => setTimeout(done, 100))")
    time = browser.run("return kds.state().step + kds.state().u")
    check(abs(time - 3.5) < 0.05, f"a drag to the middle went to {time} of 7")


def link_restores(browser, replay):
    browser.wait("await kds.seekEvent(1, 5); await new Promise((done) => setTimeout(done, 700))")
    fragment = browser.run("return location.hash")
    state = state_of(browser)
    browser.open(replay, fragment)
    check(state_of(browser) == state, "the link opens another state")
    check(browser.run("return document.querySelector('#event h3').textContent").startswith("power"), "the event is not chosen")


def event_is_named_and_kinds_are_skipped(browser):
    """The sentence of an event of a sphere has its beads and residues; n skips kinds whose box is off."""
    wrapped = browser.wait("""const said = [];
        for (let e = 0; e < 6; ++e) {
          await kds.seekEvent(0, e);
          const node = [...document.querySelectorAll("#event dt")].find((dt) => dt.textContent === "node");
          const signs = [...document.querySelectorAll("#event-now .comes, #event-now .goes")].map((span) => span.textContent);
          said.push([document.getElementById("event-now").textContent, signs, node.nextSibling.textContent]);
        }
        return said""")
    for text, signs, node in wrapped:
        check(signs and all("ALA" in sign and sign[0] in "◆✕" for sign in signs), f"no bead is marked: {text}")
        check(node in text or "residue" in text, f"the node is not named: {text}, {node}")
    kinds = """const click = (name) => [...document.querySelectorAll(".chip")].find((chip) => chip.textContent.startsWith(name)).querySelector("input").click();
        args[0].forEach(click);
        await kds.seek(0, 0);
        const seen = [];
        for (let k = 0; k < 20; ++k) {
          document.getElementById("next-event").click();
          await new Promise((done) => setTimeout(done, 40));
          seen.push(document.querySelector("#event h3").textContent);
        }
        args[0].forEach(click);
        return seen"""
    seen = browser.wait(kinds, ["3-2", "2-3", "begin"])
    check({kind.split(": ")[1] for kind in seen} <= {"enter", "leave", "pivot", "end"}, f"n went to {seen}")
    check("contacts: end" in seen, f"n went to no end of a contact: {seen}")


def depth_in(triangle, x, y):
    """Returns how far a point lies within a triangle: its least distance from a side, negative outside."""
    distances = []
    for (ax, ay), (bx, by), (cx, cy) in zip(triangle, triangle[1:] + triangle[:1], triangle[2:] + triangle[:2]):
        length = ((bx - ax)**2 + (by - ay)**2)**0.5
        left, third = ((bx - ax) * (q - ay) - (by - ay) * (p - ax) for p, q in ((x, y), (cx, cy)))
        distances.append((left if third > 0 else -left) / max(length, 1e-9))
    return min(distances)


def faces_are_drawn(browser, layer):
    """Pixels are drawn where a triangle, or a side of a tetrahedron, is projected, and nowhere else."""
    picture = pixels(browser, layer)
    shown = marked(picture)
    simplices = browser.run("return kds.state()[arguments[0]].map((beads) => beads.map(kds.project))", layer)
    triangles = [triple for simplex in simplices for triple in itertools.combinations(simplex, 3)]
    seen = [0, 0]
    for x, y in itertools.product(range(0, len(picture[0]), 13), range(0, len(picture), 13)):
        depth = max(depth_in(triangle, x + 0.5, y + 0.5) for triangle in triangles)
        if abs(depth) > 1:  # the edge of a triangle crosses other pixels
            check(((x, y) in shown) == (depth > 0), f"{layer}: pixel {x}, {y} lies {depth} within a triangle")
            seen[depth > 0] += 1
    check(min(seen) > 20, f"{layer}: {seen} pixels outside and within triangles")


def every_structure_is_drawn(browser, node, page, place):
    for dimension in ("2", "3"):
        replay = os.path.join(place, f"still{dimension}.html")
        subprocess.run([node, os.path.join(page, "tests", "make_replay.mjs"), os.path.join(page, "dist", "replay_page.html"),
                        replay, "24", "3", dimension, "Still", "still"], check=True)
        browser.open(replay)
        browser.run("document.getElementById('all-levels').click()")
        for layer in ("boxes", "box", "hull", "closest", "spheres", "links"):
            drawn = marked(pixels(browser, layer))
            check(len(drawn) > 60, f"{layer} has {len(drawn)} pixels")
        for layer in ("triangles", "voids"):
            faces_are_drawn(browser, layer)
        check(browser.run("return document.getElementById('ranks').hidden"), "the order is shown, though it is off")
        pixels(browser, "order", "closest")
        colours = browser.run("""const c = document.getElementById("ranks");
            const {data} = c.getContext("2d").getImageData(0, c.height - 2, c.width, 1), seen = new Set();
            for (let k = 0; k < data.length; k += 4) seen.add(data.slice(k, k + 3).join());
            return seen.size""")
        check(colours >= 2, "the order has no stripes")
        distance = browser.run("return document.getElementById('closest-label').textContent")
        state = browser.run("const {closest: [[a, b]], positions: p} = kds.state(); return [...p.slice(3 * a, 3 * a + 3), ...p.slice(3 * b, 3 * b + 3)]")
        expected = sum((x - y)**2 for x, y in zip(state[:3], state[3:]))**0.5
        check(abs(float(distance.split()[0]) - expected) < 1e-3, f"the distance is {expected}, shown as {distance}")
        text = browser.run("return document.body.innerText")
        check("Press" not in text, "a page without events says to press a key")


def works_on_a_phone(browser):
    browser.size(390, 844)
    browser.wait("await new Promise((done) => setTimeout(done, 200))")
    check(browser.run("return document.documentElement.scrollWidth") <= 390, "the page is wider than a phone")


def works_without_webgl(replay):
    with Browser(webgl=False) as browser:
        browser.open(replay)
        check(browser.run("return !document.getElementById('no-webgl').hidden"), "no sentence about WebGL2")
        browser.wait("await kds.seekEvent(0, 0)")
        check("wrapped" in browser.run("return document.getElementById('event').textContent"), "no event is shown")
        drawn = browser.run("""const c = document.querySelector("#rows canvas");
            return c.getContext("2d").getImageData(0, 0, c.width, c.height).data.some((v) => v > 0)""")
        check(drawn, "the timeline is blank")
        complaints = browser.complaints()
        check(not complaints, f"the page complains: {complaints}")


def main(node, page, place):
    os.makedirs(place, exist_ok=True)
    replay = os.path.join(place, "replay.html")
    subprocess.run([node, os.path.join(page, "tests", "make_replay.mjs"), os.path.join(page, "dist", "replay_page.html"),
                    replay, "24", "8", "3", TITLE], check=True)
    with Browser() as browser:
        browser.open(replay)
        check(browser.run("return document.getElementById('title').textContent") == TITLE, "the title is another one")
        everything = marked(pixels(browser, "beads", "chain", "cages", "edges", "contacts", "hidden", "flashes"))
        check(len(everything) > 2000, f"only {len(everything)} pixels are drawn")
        for test in (states_agree, picking_agrees_with_pixels, cage_encloses_beads, keys_work,
                     picking_agrees_with_pixels, follows_a_bead,  # after keys_work the camera is turned and nearer
                     saves_a_picture, loops, timeline_goes_to_times, event_is_named_and_kinds_are_skipped):
            test(browser)
            print("passed:", test.__name__)
        link_restores(browser, replay)
        every_structure_is_drawn(browser, node, page, place)
        works_on_a_phone(browser)
        complaints, requests = browser.complaints(), browser.requests()
        check(not complaints, f"the page complains: {complaints}")
        check(not requests, f"the page asks the network: {requests}")
    works_without_webgl(replay)
    print("passed")


if __name__ == "__main__":
    main(*sys.argv[1:])
