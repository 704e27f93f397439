#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# `clatter run` on a terminal puts this before each stage: it notes the process and what it prints. Files that a rule makes
# of a stage's standard output stay as they are; that of make itself is $CLATTER_RUN/make.
printf '%s\n' "$*" >"$CLATTER_RUN/$$.started" && mv "$CLATTER_RUN/$$.started" "$CLATTER_RUN/$$.stage"
if [ -f /dev/stdout ] && ! [ /dev/stdout -ef "$CLATTER_RUN/make" ]; then exec "$@" 2>"$CLATTER_RUN/$$.log"; fi
exec "$@" >"$CLATTER_RUN/$$.log" 2>&1
