# SPDX-License-Identifier: Apache-2.0
# Thin: every target sets up what is missing, then calls one program. `make help` lists them.

PYTHON ?= python3
JOBS   ?= 2
FIGURE2 := scenes/torus.toml scenes/hyperboloid.toml scenes/spiral.toml
MODULE := $(T:rdx_%=%)
PROCESSORS := render-quadric render-torus render-spiral
VENV   := .venv
BIN    := $(VENV)/bin
RUN    := $(BIN)/python -m raydix.entry
READY  := $(VENV)/.ready
TESTS   = $(BIN)/python -m pytest -n $(JOBS) --dist worksteal --junitxml=build/results

.DEFAULT_GOAL := help
.PHONY: help setup render gallery test lint formats csr accuracy rules types spirals errors stress search speed realtime bench bench-full bench-check scaling explore report waves figures trace-ray synth pnr exact-spirals formal regress second mutants coverage clean distclean

help: ## this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## /{printf "  make %-13s %s\n", $$1, $$2}' $(MAKEFILE_LIST)
	@echo "  variables: PYTHON JOBS; for each target those named in its line"

setup: $(READY) ## build .venv from requirements.lock (PYTHON=python3)

$(READY): requirements.lock scripts/preflight.sh
	@sh scripts/preflight.sh "$(PYTHON)"
	@echo "setting up $(VENV) (exact versions from requirements.lock)"
	@"$(PYTHON)" -m venv --clear $(VENV)
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check -r requirements.lock
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation -e .
	@touch $@

render: $(READY) ## golden model and RTL render the paper's figure 2, or SCENE=, compared bit for bit (OUT=build/render/<scene> ARGS=)
	@$(BIN)/raydix verify $(if $(SCENE),"$(SCENE)",$(FIGURE2)) $(if $(OUT),--out "$(OUT)") $(ARGS)

gallery: $(READY) ## the same for every scene in scenes/
	@$(BIN)/raydix verify scenes/*.toml $(ARGS)

test: $(READY) ## the regression without what takes long, or one file of it (T=<module> SEED=<n> WAVES=1 JOBS=2 ALL=1: what takes long, too)
	@[ -z "$(T)" ] || [ -f "tb/test_$(MODULE).py" ] || { \
	  echo "make test: found T=$(T); allowed: $(patsubst tb/test_%.py,%,$(wildcard tb/test_*.py))" >&2; exit 2; }
	@SEED="$(SEED)" WAVES="$(WAVES)" RAYDIX_SHORT="$(if $(ALL),,1)" $(TESTS)/$(if $(T),$(MODULE),test).xml \
	  $(if $(T),-v tb/test_$(MODULE).py) $(if $(ALL),,-m "not long")

regress: $(READY) ## every test (SEED=<n> JOBS=2)
	@SEED="$(SEED)" WAVES= RAYDIX_SHORT= $(TESTS)/regress.xml

second: $(READY) ## the module tests under Icarus Verilog, with four-state values (T=<module> SEED=<n> JOBS=2 ARGS=)
	@$(RUN) scripts/second.py $(MODULE) --jobs $(JOBS) $(if $(SEED),--seed $(SEED)) $(ARGS)

formal: $(READY) ## machine proofs of the RTL, of POINT= or all of them, each also of a broken design (ARGS=)
	@$(RUN) scripts/formal.py $(POINT) $(ARGS)

coverage: $(READY) ## blocks, toggled bits and functional bins that each module's own test covers (T=<module> JOBS=2 ARGS=--write)
	@$(RUN) scripts/cover.py $(MODULE) --jobs $(JOBS) $(ARGS)

lint: $(READY) ## Verilator -Wall, Verible, pyslang, yosys read_slang, ruff, mypy, generated files
	@$(BIN)/python -m pytest -q tb/test_lint.py

formats: $(READY) ## write the constants of rtl/rdx_pkg.sv and docs/number-formats.md from their one table
	@$(BIN)/python -m raydix.formats --write

csr: $(READY) ## generate build/csr from rtl/rdx_csr.rdl: register block, C header, HTML, Python map; write docs/registers.md
	@$(BIN)/python -m raydix.csr --write

accuracy: $(READY) ## error against float64 roots of the ideal scene, of SCENE= or of every scene (ARGS=)
	@$(RUN) scripts/accuracy.py $(if $(SCENE),"$(SCENE)") $(ARGS)

rules: $(READY) ## paper rule against certified rule on random chords (ARGS=)
	@$(RUN) scripts/rules.py $(ARGS)

types: $(READY) ## both rules and every width on random chords through each algebraic type of surface (ARGS=)
	@$(RUN) scripts/every_type.py $(ARGS)

spirals: $(READY) ## random spirals against dense sampling: missed roots, error of t, steps, bounds (ARGS=)
	@$(RUN) scripts/spirals.py $(ARGS)

errors: $(READY) ## rounding errors of each stage: bound and worst found (ARGS=)
	@$(RUN) scripts/errors.py $(ARGS)

stress: $(READY) ## 10^7 difficult rays in named categories against exact roots, both rules (JOBS=2 ARGS=)
	@$(RUN) scripts/stress.py --jobs $(JOBS) $(ARGS)

search: $(READY) ## evolutionary search for the largest error and the most steps (ARGS=)
	@$(RUN) scripts/search.py $(ARGS)

exact-spirals: $(READY) ## the golden model on chords through random spirals, each verdict proved by ball arithmetic (ARGS=)
	@$(RUN) scripts/exact_spirals.py $(ARGS)

speed: $(READY) ## golden model on one and two threads, and the RTL simulation (SCENE= ARGS=)
	@$(RUN) scripts/speed.py $(if $(SCENE),"$(SCENE)") $(ARGS)

realtime: $(READY) ## cycles of a frame of the processor at 1920x1080 and the clock for 60 Hz, of SCENE= or the paper's figure 2 (ARGS=)
	@$(RUN) scripts/realtime.py $(if $(SCENE),"$(SCENE)") $(ARGS)

bench: $(READY) ## run time against error: golden model and alternatives on the same rays, five scenes or SCENE= (ARGS=)
	@$(RUN) scripts/benchmark.py $(if $(SCENE),"$(SCENE)") $(ARGS)

bench-full: $(READY) ## the same for every scene with one surface, fewer turns, and the clocks of the placed engines (ARGS=--write)
	@$(RUN) scripts/benchmark.py --full --rtl --repeats 5 $(ARGS)

bench-check: $(READY) ## compare the ratios with those kept in docs/benchmarks.json (ARGS=)
	@$(RUN) scripts/benchmark.py --check $(ARGS)

scaling: $(READY) ## time against pixels, surfaces, depth complexity, unneeded parts: golden model and processor (ARGS=)
	@$(RUN) scripts/scaling.py $(ARGS)

explore: $(READY) ## the trade-off: design points placed, simulated and compared; hours, resumes (JOBS=2 ARGS=)
	@$(RUN) scripts/explore.py --jobs $(JOBS) $(ARGS)

report: $(READY) ## one HTML page of what was rendered, tested and measured last: build/report.html (ARGS=)
	@$(RUN) scripts/report.py $(ARGS)

waves: $(READY) ## run one test with a waveform and write what shows it: GTKWave, Surfer, a picture (T=<module>, or "<module>[N1=3"; ARGS=)
	@[ -n "$(T)" ] || { echo "make waves: found no T; allowed: a module, for example T=ring" >&2; exit 2; }
	@$(RUN) scripts/waves.py "$(T)" $(if $(SEED),--seed $(SEED)) $(ARGS)

figures: $(READY) ## draw the figures of docs/method.md from what the golden model computes (ARGS=--write)
	@$(RUN) scripts/figures.py $(ARGS)

trace-ray: $(READY) ## follow the ray of a pixel through golden model and RTL, step by step, and draw it (SCENE= PIXEL=x,y ARGS=)
	@[ -n "$(SCENE)" ] && [ -n "$(PIXEL)" ] || { \
	  echo "make trace-ray: found SCENE=$(SCENE) PIXEL=$(PIXEL); allowed: both, for example SCENE=scenes/torus.toml PIXEL=300,140" >&2; exit 2; }
	@$(RUN) scripts/trace_ray.py "$(SCENE)" --pixel "$(PIXEL)" $(ARGS)

synth: $(READY) ## size and clock of modules on an ECP5 by yosys and nextpnr, of POINT= or of every point (JOBS=2 ARGS=)
	@$(RUN) scripts/synth.py $(POINT) --jobs $(JOBS) $(ARGS)

pnr: $(READY) ## place and route the processor: size, clock, slowest path, of POINT= or of each for 1080p60; half an hour each (JOBS=2 ARGS=)
	@$(RUN) scripts/synth.py $(if $(POINT),$(POINT),$(PROCESSORS)) --jobs $(JOBS) $(ARGS)

mutants: $(READY) ## small changes of the RTL, one at a time, that its tests must find, of T=<module> or all (JOBS=2 ARGS=)
	@$(RUN) scripts/mutants.py $(MODULE) --jobs $(JOBS) $(ARGS)

clean: ## remove build/
	rm -rf build

distclean: clean ## remove build/ and .venv
	rm -rf $(VENV)
