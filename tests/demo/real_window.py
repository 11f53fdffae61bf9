# SPDX-License-Identifier: MIT
"""A window of zvo-demo on an X server of its own, with real input from xdotool, and pixels from the server's memory."""

import contextlib
import ctypes
import mmap
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import time

SCREEN = (1600, 1000)
PATIENCE_SECONDS = 60  # until what should happen counts as missing
LOOK_SECONDS = 0.01    # between looks at the screen
CLICK_SECONDS = 0.1    # that a button is held
XWD_SIZE, XWD_ROW_BYTES, XWD_COLORS = 0, 12, 19  # of the words of a header of the X Window Dump format
XWD_COLOR_BYTES = 12
X_PROP_REPLACE, XA_RESOURCE_MANAGER, XA_STRING = 0, 23, 31


def missing_programs():
    return [name for name in ("Xvfb", "xdotool") if shutil.which(name) is None]


class Screen:
    """An X server without a screen that anyone sees. Its pixels are in a file, in the X Window Dump format."""

    def __init__(self, folder):
        ends = os.pipe()
        self.process = subprocess.Popen(
            ["Xvfb", "-displayfd", str(ends[1]), "-screen", "0", f"{SCREEN[0]}x{SCREEN[1]}x24", "-nolisten", "tcp",
             "-noreset", "-fbdir", str(folder)], pass_fds=[ends[1]], stderr=subprocess.DEVNULL)
        os.close(ends[1])
        with os.fdopen(ends[0]) as numbers:
            self.display = ":" + numbers.readline().strip()
        with open(folder / "Xvfb_screen0", "rb") as file:
            self.memory = mmap.mmap(file.fileno(), 0, prot=mmap.PROT_READ)
        words = struct.unpack(">25I", self.memory[:100])
        self.first = words[XWD_SIZE] + words[XWD_COLORS] * XWD_COLOR_BYTES
        self.row_bytes = words[XWD_ROW_BYTES]

    def pixels(self, x, y, width, height):
        """The bytes of a rectangle, four a pixel."""
        starts = (self.first + row * self.row_bytes + 4 * x for row in range(y, y + height))
        return b"".join(self.memory[start:start + 4 * width] for start in starts)

    def set_resolution(self, dots_per_inch):
        """As desktops tell it to programs: by a resource of the X server."""
        x = ctypes.CDLL("libX11.so.6")
        x.XOpenDisplay.restype = ctypes.c_void_p
        display = ctypes.c_void_p(x.XOpenDisplay(self.display.encode()))
        x.XDefaultRootWindow.restype = ctypes.c_ulong
        root = ctypes.c_ulong(x.XDefaultRootWindow(display))
        resources = f"Xft.dpi: {dots_per_inch}\n".encode()
        x.XChangeProperty(display, root, ctypes.c_ulong(XA_RESOURCE_MANAGER), ctypes.c_ulong(XA_STRING), 8,
                          X_PROP_REPLACE, resources, len(resources))
        x.XCloseDisplay(display)

    def close(self):
        self.memory.close()
        self.process.kill()
        self.process.wait()


class Window:
    """zvo-demo, at the screen's upper left corner."""

    def __init__(self, screen, program, folder, arguments, size):
        self.screen, self.size, self.folder = screen, size, folder
        self.environment = dict(os.environ, DISPLAY=screen.display, WAYLAND_DISPLAY="",
                                XDG_CONFIG_HOME=str(folder / "config"))
        self.errors = open(folder / "errors.txt", "w+b")
        self.start = time.monotonic()
        if size is not None:
            arguments = [*arguments, "--size", f"{size[0]}x{size[1]}"]
        self.process = subprocess.Popen([program, *arguments], cwd=folder, env=self.environment, stderr=self.errors)

    def age(self):
        return time.monotonic() - self.start

    def tell(self, *command):
        """Has xdotool do something: what it prints."""
        done = subprocess.run(["xdotool", *map(str, command)], env=self.environment, capture_output=True, text=True)
        return done.stdout.strip()

    def click_until_change(self, what, area):
        """Clicks as long as a person does, and waits until an area changes by the release: seconds from the release,
        with what xdotool takes to start."""
        self.tell("mousedown", 1, "sleep", CLICK_SECONDS)
        before = self.pixels(area)
        release = subprocess.Popen(["xdotool", "mouseup", "1"], env=self.environment)
        seconds = self.wait_for_change(what, before, area)
        release.wait()
        return seconds

    def press(self, *keys):
        self.tell("key", *keys)

    def drag(self, button, points, seconds=0.05, keys=()):
        """Presses a button of the mouse at the first point and lets it go at the last one."""
        chain = ["mousemove", *points[0], "sleep", seconds, *(word for key in keys for word in ("keydown", key)),
                 "sleep", seconds, "mousedown", button]
        for point in points[1:]:
            chain += ["sleep", seconds, "mousemove", *point]
        chain += ["sleep", seconds, "mouseup", button, *(word for key in keys for word in ("keyup", key))]
        self.tell(*chain)

    def resize(self, width, height):
        self.tell("search", "--onlyvisible", "--name", ".", "windowsize", width, height)

    def pixels(self, area=None):
        return self.screen.pixels(*(area or (0, 0, *self.size)))

    def geometry(self):
        """Its size in pixels."""
        words = dict(line.split("=") for line in self.tell("search", "--onlyvisible", "--name", ".", "getwindowgeometry",
                                                           "--shell").splitlines())
        return int(words["WIDTH"]), int(words["HEIGHT"])

    def title(self):
        return self.tell("search", "--onlyvisible", "--name", ".", "getwindowname")

    def wait(self, what, happens):
        """Waits until something happens: the seconds that it took."""
        start = time.monotonic()
        while not happens():
            if time.monotonic() - start > PATIENCE_SECONDS:
                raise AssertionError(f"{what}: not within {PATIENCE_SECONDS} s")
            if self.process.poll() is not None:
                raise AssertionError(f"{what}: the window has ended ({self.process.returncode}): {self.told()}")
            time.sleep(LOOK_SECONDS)
        return time.monotonic() - start

    def wait_for_contents(self, area=None):
        """Until something is seen: the seconds since the start."""
        self.wait("contents", lambda: len(set(self.pixels(area))) > 4)
        return self.age()

    def wait_for_change(self, what, before, area=None):
        return self.wait(what, lambda: self.pixels(area) != before)

    def wait_for_rest(self, seconds=1.0, area=None):
        """Until pixels have stayed for some time: when they changed last, in seconds, and the last pixels."""
        start, last, since = time.monotonic(), self.pixels(area), time.monotonic()
        while time.monotonic() - since < seconds:
            if time.monotonic() - start > PATIENCE_SECONDS:
                raise AssertionError(f"the picture does not rest within {PATIENCE_SECONDS} s")
            time.sleep(LOOK_SECONDS)
            now = self.pixels(area)
            if now != last:
                last, since = now, time.monotonic()
        return since - start, last

    def processor(self, seconds):
        """The share of a processor that the program takes."""
        def ticks():
            fields = pathlib.Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
            return int(fields[11]) + int(fields[12])
        before = ticks()
        time.sleep(seconds)
        return (ticks() - before) / os.sysconf("SC_CLK_TCK") / seconds

    def screenshot(self, number, *keys):
        """The bytes of the next screenshot, which F12 writes to the folder."""
        file = self.folder / f"zvo-{number:04d}.png"
        self.press(*(keys or ["shift+F12"]))
        self.wait(file.name, file.exists)
        return file.read_bytes()

    def told(self):
        self.errors.seek(0)
        return self.errors.read().decode(errors="replace")

    def end(self):
        """Ends the program by SIGTERM: its exit status."""
        self.process.send_signal(signal.SIGTERM)
        return self.process.wait(PATIENCE_SECONDS)

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self.errors.close()


@contextlib.contextmanager
def opened(program, folder, arguments, size, dots_per_inch=96):
    """A window on a new screen. size: in pixels; None: what the program chooses."""
    folder.mkdir(parents=True, exist_ok=True)
    screen = Screen(folder)
    try:
        screen.set_resolution(dots_per_inch)
        window = Window(screen, program, folder, arguments, size)
        try:
            yield window
        finally:
            window.close()
    finally:
        screen.close()
