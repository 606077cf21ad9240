# SPDX-License-Identifier: GPL-3.0-or-later
#
# Whether every C++ block of a page is part of a program that is compiled: its lines, but for indentation and empty
# lines, have to follow each other in one of the sources. Names the blocks that aren't; status 1 if there are any.
#
#   awk -f check_samples.awk SOURCE... PAGE.md...

function trimmed(line) {
  sub(/^[ \t]+/, "", line)
  sub(/[ \t]+$/, "", line)
  return line
}

FILENAME !~ /\.md$/ {
  line = trimmed($0)
  if (line != "" && line !~ /^\/\/! \[/) source[FILENAME] = source[FILENAME] "\n" line # marks of snippets don't count
  next
}

/^```cpp/ { in_block = 1; start = FNR; block = ""; next }
in_block && /^```/ {
  in_block = 0
  ++blocks
  found = 0
  for (file in source)
    if (index(source[file] "\n", block "\n")) found = 1
  if (!found) {
    print FILENAME ":" start ": no compiled program contains this block"
    ++missing
  }
  next
}
in_block { line = trimmed($0); if (line != "") block = block "\n" line }

END {
  print blocks + 0 " blocks, " missing + 0 " of them not compiled"
  exit missing > 0 || blocks == 0
}
