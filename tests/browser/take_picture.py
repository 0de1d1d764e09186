"""Takes a picture of a replay at one of its events. Usage: take_picture.py REPLAY STRUCTURE EVENT PICTURE.webp"""
import base64
import sys

from chromium import Browser


def main(replay, structure, event, picture):
    with Browser(1200, 700) as browser:
        browser.open(replay)
        browser.wait("await kds.seekEvent(...args); await new Promise((done) => setTimeout(done, 500))", int(structure),
                     int(event))
        shot = browser.driver.execute_cdp_cmd("Page.captureScreenshot", {"format": "webp", "quality": 85})
        with open(picture, "wb") as file:
            file.write(base64.b64decode(shot["data"]))


if __name__ == "__main__":
    main(*sys.argv[1:])
