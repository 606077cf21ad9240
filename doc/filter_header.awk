# SPDX-License-Identifier: GPL-3.0-or-later
#
# Shows Doxygen the paragraphs that a header starts with: the // lines after the licence become its \file comment. Line
# numbers stay as they are.
#
#   awk -f filter_header.awk HEADER

FNR == 2 && /^\/\/$/ { print "/*! \\file"; prologue = 1; next }
prologue && /^\/\// {
  line = substr($0, 3)
  sub(/^ /, "", line)
  if (line ~ /^  [^ -]/ && (was_blank || was_code)) { # indented: code
    print "  " line
    was_code = 1
    next
  }
  was_blank = line == ""
  was_code = was_code && was_blank
  print escaped(line)
  next
}
prologue { print "*/"; prologue = 0; next }
{ print }

# Outside of backticks, arrows and such are text, not HTML.
function escaped(line,    parts, n, i, result) {
  n = split(line, parts, "`")
  for (i = 1; i <= n; ++i) {
    if (i % 2 == 1) {
      gsub(/</, "\\<", parts[i])
      gsub(/>/, "\\>", parts[i])
    }
    result = result (i > 1 ? "`" : "") parts[i]
  }
  return result
}
