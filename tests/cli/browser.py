"""A browser that is started once and opens page after page: the DevTools protocol over its pipe."""

import json
import os
import select
import shutil
import subprocess
import time

from case import PATIENCE

BROWSER = next((path for name in ("chromium", "chromium-browser", "google-chrome") if (path := shutil.which(name))), None)
TIMEOUT = PATIENCE * 120  # s, of an answer


class Browser:
    def __init__(self, folder):
        commands, self.commands = os.pipe()
        self.answers, answers = os.pipe()
        # The browser reads its commands from descriptor 3 and answers on 4.
        self.process = subprocess.Popen(
            ["bash", "-c", f'exec "$@" 3<&{commands} 4>&{answers}', "browser", BROWSER, "--headless=new", "--no-sandbox", "--disable-gpu", "--remote-debugging-pipe",
             f"--user-data-dir={folder}"], pass_fds=(commands, answers), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(commands)
        os.close(answers)
        self.number, self.rest, self.events = 0, b"", []

    def close(self):
        self.call("Browser.close")
        self.process.wait(TIMEOUT)
        os.close(self.commands)
        os.close(self.answers)

    def read(self):
        """The next message: an answer or an event."""
        until = time.monotonic() + TIMEOUT
        while b"\0" not in self.rest:
            if not select.select([self.answers], [], [], max(until - time.monotonic(), 0))[0]:
                raise TimeoutError("the browser is silent")
            part = os.read(self.answers, 1 << 20)
            if not part:
                raise EOFError("the browser has ended")
            self.rest += part
        message, _, self.rest = self.rest.partition(b"\0")
        return json.loads(message)

    def call(self, method, session=None, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters, **({"sessionId": session} if session else {})}
        os.write(self.commands, json.dumps(message).encode() + b"\0")
        while (answer := self.read()).get("id") != self.number:
            self.events.append(answer)
        if "error" in answer:
            raise RuntimeError(f"{method}: {answer['error']}")
        return answer["result"]


class View:
    """A page in a tab of its own, with what its console says, from its load on."""

    def __init__(self, browser, path, size):
        self.browser, width, height = browser, *size
        browser.events.clear()
        self.target = browser.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = browser.call("Target.attachToTarget", targetId=self.target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.call(f"{domain}.enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.call("Page.navigate", url=path.as_uri())
        while not any(event["method"] == "Page.loadEventFired" for event in browser.events):
            browser.events.append(browser.read())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.browser.call("Target.closeTarget", targetId=self.target)

    def call(self, method, **parameters):
        return self.browser.call(method, self.session, **parameters)

    def value(self, expression):
        """Of a JavaScript expression, be it a promise."""
        answer = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(said(answer["exceptionDetails"]))
        return answer["result"].get("value")

    def console(self):
        self.value("0")  # all that was said before has come by then
        lines = []
        for event in self.browser.events:
            if event["method"] == "Runtime.exceptionThrown":
                lines.append(said(event["params"]["exceptionDetails"]))
            elif event["method"] == "Runtime.consoleAPICalled":
                lines.append(" ".join(str(argument.get("value")) for argument in event["params"]["args"]))
            elif event["method"] == "Log.entryAdded":
                lines.append(event["params"]["entry"]["text"])
        return lines


def said(details):
    thrown = details.get("exception", {})
    return f"{details['text']} {thrown.get('description', thrown.get('value'))}"
