# SPDX-License-Identifier: GPL-3.0-or-later
# Doxygen's view of a header, line by line: the comment after #pragma once describes the file, the comment after a
# member describes the member, indented lines of a comment (formulas, tables, drawings) keep their layout, and `<`
# and `--` in its text are just that.
function put(line) {
  if (NR > 1) print held
  held = line
}
# Text of a comment, escaped where it is neither in backticks nor in quotes.
function escaped(text, done, token) {
  while (match(text, /`[^`]*`|"[^"]*"|<|--/)) {
    token = substr(text, RSTART, RLENGTH)
    done = done substr(text, 1, RSTART - 1) (token ~ /^[`"]/ ? "" : "\\") token
    text = substr(text, RSTART + RLENGTH)
  }
  return done text
}
/^#pragma once/ { put("/// @file"); head = 1; next }
head && /^\/\// { $0 = "/" $0 }
!/^\/\// { head = 0 }

/^ *\/\/\/ (@|- |[0-9]+\. )/ { list = 1 }
!/^ *\/\/\/  / && !/^ *\/\/\/ (@|- |[0-9]+\. )/ { list = 0 }
{
  layout = /^ *\/\/\/   +[^ ]/ && !list
  if (layout && !inside) held = held " @code{.unparsed}"
  ending = !layout && inside
  inside = layout
}
layout { put($0); next }
match($0, /^ *\/\/\//) {
  put(substr($0, 1, RLENGTH) (ending ? " @endcode" : "") escaped(substr($0, RLENGTH + 1)))
  next
}
ending { held = held " @endcode" }
/^ +/ && !/^ *(\/\/|return|if|for|while)/ && match($0, /[;,] +\/\/ /) {
  put(substr($0, 1, RSTART) "  ///< " escaped(substr($0, RSTART + RLENGTH)))
  member = 1
  next
}
member && match($0, /^          *\/\/ /) {
  put(substr($0, 1, RLENGTH - 3) "///< " escaped(substr($0, RLENGTH + 1)))
  next
}
{ member = 0; put($0) }
END { print held }
