# Lobe. `make help` lists the targets.

BUILD = build
OPTIMIZE = -O3 -fno-math-errno -fno-trapping-math $(NATIVE)
WARN = -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion $(if $(WERROR),-Werror)
CFLAGS = $(OPTIMIZE)
ARGS =
SECONDS = 60
COUNT = 60
SEED = 1
JOBS = 2

# What this compiler has: tuning for this machine, threads. Each is used only if a program links with it.
has = $(shell mkdir -p $(BUILD) && echo 'int main(void) { return 0; }' > $(BUILD)/probe.c && \
        $(CC) $(1) $(BUILD)/probe.c -o $(BUILD)/probe 2>/dev/null && echo '$(1)')
ifeq ($(filter help clean install uninstall,$(MAKECMDGOALS)),)
NATIVE := $(call has,-march=native)
OPENMP := $(call has,-fopenmp)
endif
COMPILE = $(CC) -std=c99 $(WARN) $(CFLAGS)

HEADERS = sg.h asg.h fis.h ggx_bound.h bilateral.h
EXAMPLES = vsgl glossy_plane light_culling env_lights lobe_filter
COMMON = $(filter-out $(wildcard examples/common/gpu*.c),$(wildcard examples/common/*.c))
TESTS = $(wildcard tests/*.c)
FUZZ = $(patsubst tests/fuzz/%.c,%,$(wildcard tests/fuzz/*.c))

run: vsgl

$(EXAMPLES): %: $(BUILD)/%
	$< $(ARGS)

# Two jobs at a time, also where make was not told so.
TWO_JOBS = $(MAKE) $(if $(filter -j%,$(MAKEFLAGS)),,-j2) --no-print-directory

test: force
	@+$(TWO_JOBS) $(BUILD)/tests headers readme vectors
	$(BUILD)/tests $(ARGS)

# As drop-in as it says: tests/compile/check.sh lists the steps. JOBS of them run at a time, ARGS=NAME some of them.
JOBS = 2

check: $(BUILD)/flags
	@MAKE="$(MAKE)" JOBS=$(JOBS) sh tests/compile/check.sh $(BUILD) "$(ARGS)"

bench: $(BUILD)/bench
	$(BUILD)/bench $(ARGS)

# A page of it all, and of the examples, in BUILD/report; by QUICK=1 less of each.
report: force
	@sh tests/report/report.sh $(BUILD) '$(QUICK)' $(MAKE) '$(CC)'
	@sh tests/report/check.sh $(BUILD)/report

help:
	@echo 'make                 builds and runs the main example: one-bounce glossy indirect light'
	@echo 'make glossy_plane    an example: a sphere light over a glossy plane, as SGs and as ASGs'
	@echo 'make light_culling   an example: glossy caustics from 65,536 lights, culled with four bounding volumes'
	@echo 'make env_lights      an example: an environment map as SG lights, ARGS="--map FILE" for one of yours'
	@echo 'make lobe_filter     an example: filters of noisy glossy light that know the reflection lobes'
	@echo 'make gpu             the shaders on a Vulkan device beside the same on the CPU: pictures and times'
	@echo '                     each takes ARGS="--help"'
	@echo 'make test            compiles each header alone, the README'\''s snippet and the loops, then runs the unit tests'
	@echo 'make check           make test, and the headers in all C and C++ there is, under other flags, on other machines,'
	@echo '                     after hostile headers, in programs by CMake and pkg-config: 12 minutes on 2 cores'
	@echo 'make bench           speed beside error of every function, ours and the alternatives (ARGS=sg_eval for one)'
	@echo 'make report          measures all that, the examples and how costs grow, and writes a page of plots and tables; QUICK=1 less'
	@echo 'make fuzz            SECONDS=60 of random arguments for each header, and random files for the readers (FUZZ=fis for one)'
	@echo 'make mutation        whether the unit tests notice COUNT=60 small faults of each header (all, SEED=1, HEADER=sg.h, JOBS=2)'
	@echo 'make test-shaders    compiles the shaders in both languages and runs them on a Vulkan device, by the same unit tests'
	@echo 'make hlsl            makes the HLSL shaders anew from the GLSL ones'
	@echo 'make setup           installs the Debian packages that these take'
	@echo 'make pictures        the README'\''s pictures anew, by netpbm and gnuplot'
	@echo 'make install         copies the headers to PREFIX=/usr/local, below DESTDIR, with lobe.pc; make uninstall'
	@echo 'make clean           deletes $(BUILD)/'
	@echo 'make help            prints this'
	@echo
	@echo 'CC=clang, CFLAGS=..., BUILD=directory, WERROR=1 and ARGS=... may be added to each'

VERSION = $(shell awk '$$2 == "LOBE_VERSION" && NF > 2 { printf "%d.%d.%d", $$3 / 10000, $$3 / 100 % 100, $$3 % 100; exit }' sg.h)
PREFIX = /usr/local
INSTALL_HEADERS = $(DESTDIR)$(PREFIX)/include/lobe
INSTALL_PKGCONFIG = $(DESTDIR)$(PREFIX)/share/pkgconfig

install:
	mkdir -p $(INSTALL_HEADERS) $(INSTALL_PKGCONFIG)
	cp $(HEADERS) $(INSTALL_HEADERS)
	chmod 644 $(HEADERS:%=$(INSTALL_HEADERS)/%)
	printf '%s\n' 'prefix=$(PREFIX)' '' 'Name: lobe' 'Description: glossy many-light rendering, header-only' \
	    'Version: $(VERSION)' 'Cflags: -I$${prefix}/include/lobe' 'Libs: -lm' > $(INSTALL_PKGCONFIG)/lobe.pc
	chmod 644 $(INSTALL_PKGCONFIG)/lobe.pc

uninstall:
	rm -f $(HEADERS:%=$(INSTALL_HEADERS)/%) $(INSTALL_PKGCONFIG)/lobe.pc
	[ ! -d $(INSTALL_HEADERS) ] || rmdir $(INSTALL_HEADERS)

clean:
	rm -rf $(BUILD)

COMMON_OBJECTS = $(COMMON:examples/common/%.c=$(BUILD)/common/%.o)

$(BUILD)/common/%.o: examples/common/%.c $(wildcard examples/common/*.h) $(HEADERS) $(BUILD)/flags
	@mkdir -p $(BUILD)/common
	$(COMPILE) $(OPENMP) -c $< -o $@

$(EXAMPLES:%=$(BUILD)/%): $(BUILD)/%: examples/%.c $(COMMON_OBJECTS) $(wildcard examples/common/*.h) $(HEADERS) $(BUILD)/flags
	$(COMPILE) $(OPENMP) $< $(COMMON_OBJECTS) -o $@ -lm

# tests/raster.c includes examples/common/raster.c, to count its memory.
TEST_OBJECTS = $(TESTS:tests/%.c=$(BUILD)/unit/%.o) $(BUILD)/unit/file.o

$(BUILD)/tests: force | $(BUILD)/flags
	@mkdir -p $(BUILD)/unit
	@+$(TWO_JOBS) $(TEST_OBJECTS)
	$(COMPILE) $(TEST_OBJECTS) -o $@ -lm

$(BUILD)/unit/%.o: tests/%.c $(wildcard tests/*.h examples/common/raster.* examples/common/file.h) $(HEADERS) $(BUILD)/flags
	$(COMPILE) -c $< -o $@

$(BUILD)/unit/file.o: examples/common/file.c examples/common/file.h $(BUILD)/flags
	$(COMPILE) -c $< -o $@

# The loops are compiled twice: as vector and as scalar code, by nothing but -O3 for this machine, in the C that
# compilers default to, which contracts a * b + c.
BENCH_COMPILE = $(CC) -std=gnu99 $(WARN) -O3 $(NATIVE)
BENCH_LOOPS = $(wildcard tests/bench/*_loops.c)
BENCH_SOURCES = $(filter-out $(BENCH_LOOPS),$(wildcard tests/bench/*.c)) tests/random.c tests/bounds.c \
                $(addprefix examples/common/,csv.c fail.c file.c image.c output.c progress.c)
BENCH_KINDS = scalar vector $(BENCH_COUNTED)
BENCH_OBJECTS = $(foreach kind,$(BENCH_KINDS),$(BENCH_LOOPS:tests/bench/%.c=$(BUILD)/%_$(kind).o))

# Where the compiler knows C++, a third time, as code that counts its floating-point operations.
ifeq ($(filter help clean,$(MAKECMDGOALS)),)
BENCH_COUNTED := $(shell $(CC) -x c++ -std=c++17 -include math.h -fsyntax-only /dev/null 2>/dev/null && echo counted)
endif

$(BUILD)/bench: $(BENCH_SOURCES) $(BENCH_OBJECTS) $(wildcard tests/*.h tests/bench/*.h examples/common/*.h) $(HEADERS)
	$(COMPILE) $(BENCH_COUNTED:counted=-DBENCH_HAS_COUNTED) $(BENCH_SOURCES) $(BENCH_OBJECTS) -o $@ -lm

$(BUILD)/%_counted.o: tests/bench/%.c $(wildcard tests/*.h tests/bench/*.h) $(HEADERS) $(BUILD)/flags
	$(CC) -x c++ -std=c++17 -O1 -fno-exceptions -include tests/bench/counted.h -c $< -o $@

$(BUILD)/%_vector.o: tests/bench/%.c $(wildcard tests/*.h tests/bench/*.h) $(HEADERS) $(BUILD)/flags
	$(BENCH_COMPILE) -c $< -o $@

$(BUILD)/%_scalar.o: tests/bench/%.c $(wildcard tests/*.h tests/bench/*.h) $(HEADERS) $(BUILD)/flags
	$(BENCH_COMPILE) -DBENCH_SCALAR -fno-tree-vectorize -fno-tree-slp-vectorize -c $< -o $@

# Time against size. Without threads, so that what is timed is one of them, and not what others take from it. culling.c
# includes examples/light_culling.c, for its stages.
GROWTH = $(wildcard tests/growth/*.c) $(COMMON)

$(BUILD)/growth: $(GROWTH) examples/light_culling.c $(wildcard tests/growth/*.h examples/common/*.h) $(HEADERS) $(BUILD)/flags
	$(COMPILE) $(GROWTH) -o $@ -lm

# Each of tests/fuzz for some seconds, from the files that a script beside it makes. What it learns stays in BUILD/fuzz.
FUZZ_CC = $(if $(findstring clang,$(CC)),$(CC),clang)
FUZZ_FLAGS = -fsanitize=fuzzer,address,undefined,float-cast-overflow -fno-sanitize-recover=all

fuzz: $(BUILD)/flags
	@echo 'int LLVMFuzzerTestOneInput(void); int LLVMFuzzerTestOneInput(void) { return 0; }' > $(BUILD)/fuzz.c
	@$(FUZZ_CC) $(FUZZ_FLAGS) $(BUILD)/fuzz.c -o $(BUILD)/fuzz.probe > $(BUILD)/fuzz.log 2>&1 || { cat $(BUILD)/fuzz.log; \
	    echo "make fuzz: $(FUZZ_CC) does not link with libFuzzer: install clang with its compiler-rt libraries"; exit 1; }
	@set -e; for name in $(FUZZ); do \
	    mkdir -p $(BUILD)/fuzz/$$name; \
	    [ ! -e tests/fuzz/$$name.sh ] || sh tests/fuzz/$$name.sh $(BUILD)/fuzz/$$name; \
	    $(FUZZ_CC) -std=c99 $(WARN) -O1 -g $(FUZZ_FLAGS) tests/fuzz/$$name.c -o $(BUILD)/fuzz.$$name -lm; \
	    $(BUILD)/fuzz.$$name -max_total_time=$(SECONDS) -timeout=10 -max_len=2048 -len_control=0 -use_value_profile=1 \
	        -print_final_stats=1 $(FUZZ_ARGS) -artifact_prefix=$(BUILD)/fuzz.$$name. $(BUILD)/fuzz/$$name > $(BUILD)/fuzz.log 2>&1 || \
	        { cat $(BUILD)/fuzz.log; exit 1; }; \
	    grep -E 'DONE|stat::number_of_executed' $(BUILD)/fuzz.log; echo "ok     fuzz $$name, $(SECONDS) s"; \
	done

# Small faults of the headers, drawn by SEED, one at a time: do the tests of each notice? Results stay in BUILD/mutation.
HEADER = $(HEADERS)

mutation:
	@sh tests/mutation/mutate.sh $(BUILD) "$(CC)" $(COUNT) $(SEED) $(JOBS) $(HEADER)

# Each header alone, as C99 and, where the compiler knows it, as C++17.
headers: $(BUILD)/flags
	@for header in $(HEADERS); do \
	    echo "#include \"$$header\"" > $(BUILD)/alone.c; \
	    $(CC) -std=c99 $(WARN) -Werror -I. -fsyntax-only $(BUILD)/alone.c || exit 1; \
	    echo "ok     $$header alone, C99"; \
	    if echo '#include <math.h>' | $(CC) -x c++ -std=c++17 -fsyntax-only - 2>/dev/null; then \
	        $(CC) -x c++ -std=c++17 $(WARN) -Werror -I. -fsyntax-only $(BUILD)/alone.c || exit 1; \
	        echo "ok     $$header alone, C++17"; \
	    else echo "skipped $$header as C++17: $(CC) has no C++ here"; fi; \
	done

vectors: $(BUILD)/flags
	@sh tests/compile/vectors.sh $(CC) $(BUILD)

# What the README and the other pages say.
readme: $(BUILD)/flags
	@sh tests/compile/readme.sh $(CC) $(BUILD)

pictures: $(EXAMPLES:%=$(BUILD)/%)
	sh examples/images/make.sh $(BUILD)

# Shaders. Those of glsl/ are the source, those of hlsl/ are made from them by `make hlsl`.
GLSL = examples/shaders/glsl
HLSL = examples/shaders/hlsl
SHADERS = $(wildcard $(GLSL)/* $(HLSL)/* examples/shaders/hlsl.sh)
SHADER_PACKAGES = glslang-tools spirv-tools mesa-vulkan-drivers libvulkan-dev
REPORT_PACKAGES = gnuplot-nox
CHECK_PACKAGES = gcc g++ libc6-dev clang libclang-rt-dev libomp-dev tcc cmake pkg-config netpbm qemu-user wine wine64 gcc-mingw-w64-x86-64 \
                 gcc-i686-linux-gnu libc6-dev-i386-cross gcc-aarch64-linux-gnu libc6-dev-arm64-cross \
                 gcc-s390x-linux-gnu libc6-dev-s390x-cross

setup:
	apt-get update
	apt-get install -y --no-install-recommends $(SHADER_PACKAGES) $(REPORT_PACKAGES) $(CHECK_PACKAGES)

hlsl:
	@mkdir -p $(HLSL)
	@for shader in $(notdir $(wildcard $(GLSL)/*)); do \
	    sh examples/shaders/hlsl.sh $(GLSL)/$$shader > $(HLSL)/$${shader%.glsl}.hlsl || exit 1; done

shader-tools:
	@missing=; \
	for tool in glslangValidator spirv-val; do command -v $$tool > /dev/null || missing="$$missing $$tool"; done; \
	echo '#include <vulkan/vulkan.h>' | $(CC) -E - > /dev/null 2>&1 || missing="$$missing vulkan/vulkan.h"; \
	[ -z "$$missing" ] || { echo "missing:$$missing"; \
	    echo 'On Debian, make setup installs all: $(SHADER_PACKAGES)'; exit 1; } >&2

test-shaders: $(BUILD)/shader_tests $(BUILD)/pipeline_tests
	$(BUILD)/pipeline_tests $(BUILD)/shaders
	$(BUILD)/shader_tests $(BUILD)/shaders $(ARGS)

$(BUILD)/shaders/compiled: $(SHADERS) $(wildcard tests/shaders/*) $(HEADERS) | shader-tools
	@sh tests/shaders/compile.sh $(GLSL) $(HLSL) $(BUILD)/shaders
	@touch $@

# The tests of the headers, but that a call of a function that shaders have asks the GPU.
SHADER_TESTS = $(filter-out tests/main.c,$(TESTS)) $(wildcard tests/shaders/*.c) \
               $(addprefix examples/common/,gpu.c fail.c file.c)

$(BUILD)/shader_tests: $(SHADER_TESTS) $(BUILD)/shaders/compiled $(wildcard tests/*.h tests/shaders/*.h examples/common/*.h) \
                       $(HEADERS) $(BUILD)/flags
	$(COMPILE) -I. -include $(BUILD)/shaders/redirect.h $(SHADER_TESTS) -o $@ -lvulkan -lm

# cull.c includes examples/light_culling.c, for its stages.
PIPELINE_TESTS = $(wildcard tests/shaders/pipelines/*.c) $(COMMON) $(wildcard examples/common/gpu*.c)

$(BUILD)/pipeline_tests: $(PIPELINE_TESTS) $(BUILD)/shaders/compiled $(wildcard tests/shaders/pipelines/*.h examples/common/*.h) \
                         examples/light_culling.c $(HEADERS) $(BUILD)/flags
	$(COMPILE) $(OPENMP) $(PIPELINE_TESTS) -o $@ -lvulkan -lm

$(BUILD)/gpu: examples/gpu.c $(COMMON) $(wildcard examples/common/gpu*.c examples/common/*.h) $(BUILD)/shaders/compiled \
              $(HEADERS) $(BUILD)/flags
	$(COMPILE) $(OPENMP) $(filter %.c,$^) -o $@ -lvulkan -lm

gpu: $(BUILD)/gpu
	$< --shaders $(BUILD)/shaders $(ARGS)

# Changes when the compiler or its flags do, so that everything is built anew then.
$(BUILD)/flags: force
	@mkdir -p $(BUILD)
	@echo '$(COMPILE) $(OPENMP)' | cmp -s - $@ || echo '$(COMPILE) $(OPENMP)' > $@

.PHONY: run $(EXAMPLES) gpu test check install uninstall bench report pictures fuzz mutation setup hlsl shader-tools test-shaders help clean headers vectors readme force
