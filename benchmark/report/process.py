# SPDX-License-Identifier: GPL-3.0-or-later
"""Programs run as processes of their own, with a time limit, user seconds and peak memory; and the machine they run on."""

import datetime
import json
import os
import pathlib
import shutil
import signal
import statistics
import subprocess
import tempfile
import threading
import time


class Outcome:
    """What came of one run of a program."""

    def __init__(self, failure, status, seconds, wall, memory, output, log):
        self.failure = failure  # why there is no result; empty if there may be one
        self.status = status
        self.seconds = seconds  # user time
        self.wall = wall
        self.memory = memory  # peak of the resident set, bytes; not below what this script had when it started the program
        self.output = output
        self.log = log

    def json(self):
        return json.loads(self.output)


def run(command, limit, statuses=(0,)):
    """Runs a program until it ends or its limit, in seconds of wall time, has passed. Never raises for what it does.

    :param statuses: exit statuses of a program that has done its work.
    """
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as log:
        start = time.monotonic()
        try:
            child = subprocess.Popen([str(c) for c in command], stdin=subprocess.DEVNULL, stdout=out, stderr=log,
                                     start_new_session=True)
        except OSError as error:
            return Outcome(f"can't be started: {error.strerror}", -1, 0, 0, 0, "", "")
        expired = threading.Event()

        def end():
            expired.set()
            try:
                os.killpg(child.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass

        timer = threading.Timer(limit, end)
        timer.start()
        _, status, usage = os.wait4(child.pid, 0)
        timer.cancel()
        wall = time.monotonic() - start
        child.returncode = os.waitstatus_to_exitcode(status)
        texts = []
        for file in (out, log):
            file.seek(0)
            texts.append(file.read().decode(errors="replace"))
    failure = ""
    if expired.is_set():
        failure = f"timed out after {limit:g} s"
    elif child.returncode < 0:
        failure = f"crashed (signal {-child.returncode})"
    elif child.returncode not in statuses:
        lines = [line for line in (texts[1] or texts[0]).splitlines() if line.strip()]
        failure = f"failed (status {child.returncode})" + (f": {lines[-1].strip()[:120]}" if lines else "")
    return Outcome(failure, child.returncode, usage.ru_utime, wall, usage.ru_maxrss * 1024, *texts)


def median(values):
    return statistics.median(values) if values else float("nan")


def python_with(module):
    """The first Python that has a module, or None."""
    for python in ("python3", "/usr/bin/python3"):
        if shutil.which(python) and not run([python, "-c", f"import {module}"], 60).failure:
            return python
    return None


def machine():
    """One line about where this runs."""
    model = "unknown processor"
    try:
        for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                model = line.split(":", 1)[1].strip()
                break
        kilobytes = int(pathlib.Path("/proc/meminfo").read_text().split()[1])
    except OSError:
        kilobytes = 0
    date = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC")
    return (f"{date}, {model}, {os.cpu_count()} processors, shared, {kilobytes / 2**20:.0f} GB, "
            f"load {os.getloadavg()[0]:.1f} at the start")
