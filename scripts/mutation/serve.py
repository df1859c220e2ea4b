# SPDX-License-Identifier: Apache-2.0
"""In the simulator, before its tests: a copy of the process for each mutant, so that none starts from nothing.

cocotb imports this module before the module of the tests. The import returns in the copies only. RDX_SERVE names a
JSON file: mutants, module, results, space (a folder), jobs, factor. A result is a JSON line: mutant, outcome, detail,
seconds.
"""

import importlib
import json
import os
import re
import resource
import shutil
import signal
import tempfile
import traceback
from pathlib import Path
from xml.etree import ElementTree

import cocotb


def become(mutant, folder, seconds):
    """In the copy: which mutant, where its results go, how long it may compute."""
    os.environ["RDX_MUTANT"] = str(mutant)
    os.environ["COCOTB_RESULTS_FILE"] = str(Path(folder, "results.xml"))
    os.environ["COCOTB_MAX_FAILURES"] = "1"
    log = os.open(Path(folder, "log"), os.O_WRONLY | os.O_CREAT, 0o600)
    os.dup2(log, 1)
    os.dup2(log, 2)
    os.chdir(folder)
    if seconds:
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
        signal.alarm(20 * seconds + 60)  # for one that waits; computing time does not depend on what else runs
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    cocotb.simulator.stop_simulator = lambda: os._exit(0)  # the simulator's end would wait for threads of the original


def judge(folder, status):
    """Outcome (survived, check, assertion, timeout) and detail of a copy that has ended with ``status``."""
    results, log = Path(folder, "results.xml"), Path(folder, "log").read_text(errors="replace")
    if results.exists():
        cases = list(ElementTree.parse(results).getroot().iter("testcase"))
        bad = [c.get("name") for c in cases if c.find("failure") is not None or c.find("error") is not None]
        stopped = re.search(r"%Error: \S+: Assertion failed in (.*)|%Error: (.*)", log)
        if stopped:
            return "assertion", (stopped[1] or stopped[2] or "")[:200]
        if bad:
            return "check", bad[0]
        if status == 0:
            ran = [c for c in cases if c.find("skipped") is None]
            return ("survived", "") if ran else ("check", "no check ran")
    if (
        "%Error" not in log
        and os.WIFSIGNALED(status)
        and os.WTERMSIG(status) in (signal.SIGKILL, signal.SIGXCPU, signal.SIGALRM)
    ):
        return "timeout", ""
    stopped = re.search(r"%Error: (.*)", log)
    return "assertion", (stopped[1] if stopped else f"the simulator ended with status {status}")[:200]


def serve():
    """Fork, wait, write results; returns in the copies only."""
    order = json.loads(Path(os.environ["RDX_SERVE"]).read_text())
    importlib.import_module(order["module"])  # once for all copies
    waiting, running, limit = list(order["mutants"]), {}, 0
    space = order["space"]  # the original's caller removes it
    while waiting or running:
        while waiting and len(running) < (order["jobs"] if limit else 1):
            mutant = waiting.pop(0)
            folder = tempfile.mkdtemp(dir=space)
            pid = os.fork()
            if pid == 0:
                become(mutant, folder, limit)
                return
            running[pid] = mutant, folder
        pid, status, used = os.wait4(-1, 0)
        mutant, folder = running.pop(pid)
        outcome, detail = judge(folder, status)
        seconds = used.ru_utime + used.ru_stime
        line = dict(mutant=mutant, outcome=outcome, detail=detail, seconds=round(seconds, 2))
        if mutant == 0:
            limit = int(order["factor"] * seconds + 2)
            if outcome != "survived":
                line["log"] = Path(folder, "log").read_text(errors="replace")[-3000:]
                waiting = []
        with open(order["results"], "a") as out:
            print(json.dumps(line), file=out)
        shutil.rmtree(folder)
    os._exit(0)


if "RDX_SERVE" in os.environ:
    try:
        serve()
    except BaseException:
        traceback.print_exc()
        os._exit(1)
