# Lobe. `make help` lists the targets.

BUILD = build
OPTIMIZE = -O3 -fno-math-errno -fno-trapping-math $(NATIVE)
WARN = -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion $(if $(WERROR),-Werror)
CFLAGS = $(OPTIMIZE)
ARGS =

# What this compiler has: tuning for this machine, threads. Each is used only if a program links with it.
has = $(shell mkdir -p $(BUILD) && echo 'int main(void) { return 0; }' > $(BUILD)/probe.c && \
        $(CC) $(1) $(BUILD)/probe.c -o $(BUILD)/probe 2>/dev/null && echo '$(1)')
ifeq ($(filter help clean,$(MAKECMDGOALS)),)
NATIVE := $(call has,-march=native)
OPENMP := $(call has,-fopenmp)
endif
COMPILE = $(CC) -std=c99 $(WARN) $(CFLAGS)

HEADERS = sg.h asg.h fis.h ggx_bound.h bilateral.h
EXAMPLES = vsgl glossy_plane light_culling lobe_filter
COMMON = $(wildcard examples/common/*.c)
TESTS = $(wildcard tests/*.c)

run: vsgl

$(EXAMPLES): %: $(BUILD)/%
	$< $(ARGS)

test: $(BUILD)/tests headers readme vectors
	$(BUILD)/tests $(ARGS)

bench: $(BUILD)/bench
	$(BUILD)/bench $(ARGS)

help:
	@echo 'make                 builds and runs the main example: one-bounce glossy indirect light'
	@echo 'make glossy_plane    an example: a sphere light over a glossy plane, as SGs and as ASGs'
	@echo 'make light_culling   an example: glossy caustics from 65,536 lights, culled with four bounding volumes'
	@echo 'make lobe_filter     an example: filters of noisy glossy light that know the reflection lobes, and those that do not'
	@echo '                     each takes ARGS="--help"'
	@echo 'make test            compiles each header alone, the README'\''s snippet and the loops, then runs the unit tests'
	@echo 'make bench           speed beside error of every function, ours and the alternatives (ARGS=sg_eval for one)'
	@echo 'make clean           deletes $(BUILD)/'
	@echo 'make help            prints this'
	@echo
	@echo 'CC=clang, CFLAGS=..., BUILD=directory, WERROR=1 and ARGS=... may be added to each'

clean:
	rm -rf $(BUILD)

$(EXAMPLES:%=$(BUILD)/%): $(BUILD)/%: examples/%.c $(COMMON) $(wildcard examples/common/*.h) $(HEADERS) $(BUILD)/flags
	$(COMPILE) $(OPENMP) $< $(COMMON) -o $@ -lm

$(BUILD)/tests: $(TESTS) $(wildcard tests/*.h) $(HEADERS) $(BUILD)/flags
	$(COMPILE) $(TESTS) -o $@ -lm

# The loops are compiled twice: as vector and as scalar code, by nothing but -O3 for this machine, in the C that
# compilers default to, which contracts a * b + c.
BENCH_COMPILE = $(CC) -std=gnu99 $(WARN) -O3 $(NATIVE)
BENCH_LOOPS = $(wildcard tests/bench/*_loops.c)
BENCH_SOURCES = $(filter-out $(BENCH_LOOPS),$(wildcard tests/bench/*.c)) tests/random.c
BENCH_OBJECTS = $(BENCH_LOOPS:tests/bench/%.c=$(BUILD)/%_scalar.o) $(BENCH_LOOPS:tests/bench/%.c=$(BUILD)/%_vector.o)

$(BUILD)/bench: $(BENCH_SOURCES) $(BENCH_OBJECTS)
	$(COMPILE) $^ -o $@ -lm

$(BUILD)/%_vector.o: tests/bench/%.c $(wildcard tests/*.h tests/bench/*.h) $(HEADERS) $(BUILD)/flags
	$(BENCH_COMPILE) -c $< -o $@

$(BUILD)/%_scalar.o: tests/bench/%.c $(wildcard tests/*.h tests/bench/*.h) $(HEADERS) $(BUILD)/flags
	$(BENCH_COMPILE) -DBENCH_SCALAR -fno-tree-vectorize -fno-tree-slp-vectorize -c $< -o $@

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

# The README's first block of C, as printed.
readme: $(BUILD)/flags
	@awk '/^```/ { if (inside) exit; inside = /^```c$$/; next } inside' README.md > $(BUILD)/readme.c
	@$(CC) -std=c99 $(WARN) -Werror -I. $(BUILD)/readme.c -o $(BUILD)/readme -lm
	@$(BUILD)/readme > /dev/null && echo "ok     snippet of the README"

# Changes when the compiler or its flags do, so that everything is built anew then.
$(BUILD)/flags: force
	@mkdir -p $(BUILD)
	@echo '$(COMPILE) $(OPENMP)' | cmp -s - $@ || echo '$(COMPILE) $(OPENMP)' > $@

.PHONY: run $(EXAMPLES) test bench help clean headers vectors readme force
