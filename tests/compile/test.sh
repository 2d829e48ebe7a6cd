#!/bin/sh
# All of `make test`, by the compiler and flags that make was given. usage: test.sh FOLDER
folder=$1
. tests/compile/step.sh
step 'make test' ${MAKE:-make} test ARGS=
exit 0
