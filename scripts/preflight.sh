#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Says in one line what set-up lacks and how to get it, before anything is downloaded.
python=${1:-python3}
need() {
    command -v "$1" >/dev/null 2>&1 && return
    echo "raydix: $1 is missing; $2" >&2
    exit 1
}
need "$python" "install Python 3.11 or later (Debian: apt-get install python3 python3-venv), or name one: make PYTHON=..."
need g++ "Verilator compiles the RTL with it (Debian: apt-get install g++)"
need perl "Verilator's front end is a perl script (Debian: apt-get install perl)"
need make "Verilator builds with it (Debian: apt-get install make)"
need git "the tests list the project's files with it (Debian: apt-get install git)"
version=$("$python" -c 'import sys; print("python", sys.version_info >= (3, 11), sys.version.split()[0])' 2>/dev/null)
case "$version" in
    "python True "*) ;;
    "python False "*) echo "raydix: $python is Python ${version##* }; 3.11 or later is needed (make PYTHON=...)" >&2; exit 1 ;;
    *) echo "raydix: $python is not a working Python 3.11 or later (make PYTHON=...)" >&2; exit 1 ;;
esac
if ! "$python" -c 'import ensurepip, venv' 2>/dev/null; then
    echo "raydix: $python cannot build virtual environments (Debian: apt-get install python3-venv)" >&2
    exit 1
fi
if ! printf '#include <stdlib.h>\nint main(){return 0;}\n' | g++ -x c++ -o /dev/null - 2>/dev/null; then
    echo "raydix: g++ cannot compile; its headers are missing (Debian: apt-get install g++ libc6-dev)" >&2
    exit 1
fi
