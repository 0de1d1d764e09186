"""Starts Chromium without a window and without a network, for the tests of this folder."""
import json
import os
import shutil
import sys
import tempfile

SKIPPED = 77  # the exit code by which CTest knows a skipped test

OPTIONS = """--headless --no-sandbox --disable-gpu --enable-unsafe-swiftshader --disable-quic --no-first-run
    --disable-background-networking --disable-component-update --disable-sync --hide-scrollbars""".split()


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
except ImportError:
    skip("this Python has no selenium (Debian: python3-selenium)")


class Browser:
    """A browser with an empty profile. Use it in a `with` statement."""

    def __init__(self, width=1280, height=800, dark=False, webgl=True):
        program, driver = shutil.which("chromium"), shutil.which("chromedriver")
        if not program or not driver:
            skip("chromium or chromedriver is missing (Debian: chromium, chromium-driver)")
        self.profile = tempfile.mkdtemp()
        options = webdriver.ChromeOptions()
        options.binary_location = program
        for option in OPTIONS + [f"--window-size={width},{height}", f"--user-data-dir={self.profile}"]:
            options.add_argument(option)
        if not webgl:
            options.add_argument("--disable-3d-apis")
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        try:
            self.driver = webdriver.Chrome(service=Service(driver), options=options)
        except BaseException:
            shutil.rmtree(self.profile, ignore_errors=True)
            raise
        self.driver.set_script_timeout(60)
        self.size(width, height)
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [scheme]})

    def size(self, width, height):
        size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()
        shutil.rmtree(self.profile, ignore_errors=True)

    def open(self, path, fragment=""):
        """Opens a replay and waits until it is ready."""
        self.driver.get("about:blank")  # a new fragment alone would not load the page again
        self.driver.get("file://" + os.path.abspath(path) + fragment)
        self.wait("return kds.ready")

    def wait(self, script, *arguments):
        """Runs the body of an asynchronous function and returns its result, or raises its error."""
        code = """const done = arguments[arguments.length - 1];
            (async (...args) => { %s })(...arguments).then((value) => done({value}), (error) => done({error: String(error.stack)}));"""
        answer = self.driver.execute_async_script(code % script, *arguments)
        if "error" in answer:
            raise AssertionError(answer["error"])
        return answer.get("value")

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def complaints(self):
        """Returns the errors of the page and of the console."""
        console = [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]
        return self.run("return kds.errors") + console

    def requests(self):
        """Returns the addresses of all requests but those of opened files and of the browser itself."""
        found = []
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                found.append(message["params"]["request"]["url"])
        return [url for url in found if not url.startswith(("file:", "data:", "blob:", "about:", "chrome:"))]
