# SPDX-License-Identifier: GPL-3.0-or-later
#
# Whether every C++ block of a page is part of a program that is compiled: its lines, but for indentation and empty
# lines, have to follow each other in one of the sources. Whether every file that a page links to is there. And whether
# figures are quoted as they were measured: the number after "<!-- as NAME -->" has to be the one after
# "<!-- figure NAME -->" on a page of measurements, rounded to the digits quoted. And whether headers that pages name are
# there. Names what is wrong; status 1 if anything is.
#
#   awk -v headers="PATH PATH..." -f check_pages.awk SOURCE... PAGE.md...

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

# Names of headers in backticks, with or without folders before them.
function check_headers(line,    name) {
  while (match(line, /`[A-Za-z0-9_\/]+\.h`/)) {
    name = substr(line, RSTART + 1, RLENGTH - 2)
    line = substr(line, RSTART + RLENGTH)
    if (index(headers, "/" name " ")) continue
    print FILENAME ":" FNR ": there is no header " name
    ++missing
  }
}

# The numbers after marks of one kind, by the name of the mark.
function look_for_figures(line, kind,    name, number) {
  while (match(line, "<!-- " kind " [a-z0-9_]+ -->")) {
    name = substr(line, RSTART + length("<!-- " kind " "), RLENGTH - length("<!-- " kind "  -->"))
    line = substr(line, RSTART + RLENGTH)
    number = line
    sub(/^[^0-9<|]*/, "", number)
    if (match(number, /^[0-9]+(\.[0-9]+)?/) == 0) {
      print FILENAME ":" FNR ": no number follows the mark " name
      ++missing
      continue
    }
    number = substr(number, 1, RLENGTH)
    if (kind == "as") {
      quoted_at[++quotes] = FILENAME ":" FNR
      quoted_name[quotes] = name
      quoted[quotes] = number
    } else if (name in measured) {
      print FILENAME ":" FNR ": " name " has been measured at another place"
      ++missing
    } else
      measured[name] = number
  }
}

# Whether a number is another one, rounded to its own digits; half a last digit may go either way.
function is_rounded(number, exact,    digits, last) {
  digits = index(number, ".") ? length(number) - index(number, ".") : 0
  last = 10 ^ -digits
  return number - exact <= last / 2 * 1.000001 && exact - number <= last / 2 * 1.000001
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
!in_block {
  check_links($0)
  check_headers($0)
  look_for_figures($0, "figure")
  look_for_figures($0, "as")
}
in_block { line = trimmed($0); if (line != "") block = block "\n" line }

END {
  for (i = 1; i <= quotes; ++i)
    if (!(quoted_name[i] in measured) || !is_rounded(quoted[i], measured[quoted_name[i]])) {
      print quoted_at[i] ": " quoted[i] " is quoted, but " quoted_name[i] " is " \
          (quoted_name[i] in measured ? measured[quoted_name[i]] : "nowhere")
      ++missing
    }
  print blocks + 0 " blocks, " quotes + 0 " figures quoted, " missing + 0 " complaints"
  exit missing > 0 || blocks == 0
}
