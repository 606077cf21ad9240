# SPDX-License-Identifier: GPL-3.0-or-later
#
# Whether every C++ block of a page is part of a program that is compiled: its lines, but for indentation and empty
# lines, have to follow each other in one of the sources. And whether every file that a page links to is there. Names
# what is wrong; status 1 if anything is.
#
#   awk -f check_pages.awk SOURCE... PAGE.md...

function trimmed(line) {
  sub(/^[ \t]+/, "", line)
  sub(/[ \t]+$/, "", line)
  return line
}

function check_links(line,    target, folder) {
  folder = FILENAME
  sub(/[^\/]*$/, "", folder)
  if (line ~ /^[^[]*\]\(/) { # the filter for Doxygen looks at single lines
    print FILENAME ":" FNR ": a link goes over two lines"
    ++missing
  }
  while (match(line, /\]\([^)#]+/)) {
    target = substr(line, RSTART + 2, RLENGTH - 2)
    line = substr(line, RSTART + RLENGTH)
    if (target ~ /^[a-z]+:/) continue
    if ((getline ignored < (folder target)) < 0) {
      print FILENAME ":" FNR ": there is no file " target
      ++missing
    }
    close(folder target)
  }
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
!in_block { check_links($0) }
in_block { line = trimmed($0); if (line != "") block = block "\n" line }

END {
  print blocks + 0 " blocks, " missing + 0 " complaints"
  exit missing > 0 || blocks == 0
}
