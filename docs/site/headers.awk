# SPDX-License-Identifier: GPL-3.0-or-later
# Doxygen's view of a header, line by line: the comment after #pragma once describes the file, the comment after a
# member describes the member, and indented lines of a comment (formulas, tables, drawings) keep their layout.
function put(line) {
  if (NR > 1) print held
  held = line
}
/^#pragma once/ { put("/// @file"); head = 1; next }
head && /^\/\// { $0 = "/" $0 }
!/^\/\// { head = 0 }

/^ *\/\/\/ (@|- |[0-9]+\. )/ { list = 1 }
!/^ *\/\/\/  / && !/^ *\/\/\/ (@|- |[0-9]+\. )/ { list = 0 }
{
  layout = /^ *\/\/\/   +[^ ]/ && !list
  if (layout && !inside) held = held " @verbatim"
  if (!layout && inside && !sub(/\/\/\//, "/// @endverbatim")) held = held " @endverbatim"
  inside = layout
}
/^ +/ && !/^ *(\/\/|return|if|for|while)/ && match($0, /[;,] +\/\/ /) {
  $0 = substr($0, 1, RSTART) "  ///< " substr($0, RSTART + RLENGTH)
  put($0)
  member = 1
  next
}
member && /^          *\/\/ / { sub(/\/\/ /, "///< "); put($0); next }
{ member = 0; put($0) }
END { print held }
