# SPDX-License-Identifier: GPL-3.0-or-later
#
# Shows Doxygen what headers say without its commands: the // lines after the licence become the header's \file comment,
# and classes of the namespaces weft and weft::IO get into the group of their room (see rooms.txt). Line numbers stay as
# they are.
#
#   awk -f filter_header.awk HEADER

BEGIN {
  header = ARGV[1]
  rooms = ARGV[1]
  if (sub(/.*\/include\/weft\//, "", header)) {
    sub(/include\/weft\/.*/, "doc/rooms.txt", rooms)
    group = "room_" room_of(header, rooms)
  }
}

# The name of a header's room, without what can't be in the name of a group.
function room_of(header, rooms,    line, room, found) {
  room = header
  if (!sub(/\/[^\/]*$/, "", room))
    while (!found && (getline line < rooms) > 0) { # headers of no folder are listed
      if (line ~ /^[^+#]/) room = substr(line, 1, index(line, ": ") - 1)
      found = line == "+ " header
    }
  gsub(/[^A-Za-z0-9]+/, "_", room)
  sub(/^_/, "", room)
  sub(/_$/, "", room)
  return room
}

FNR == 2 && /^\/\/$/ { add("/** \\file"); prologue = 1; next }
prologue && /^\/\// {
  line = substr($0, 3)
  sub(/^ /, "", line)
  if (line ~ /^  [^ -]/ && (was_blank || was_code)) { # indented: code
    add("  " line)
    was_code = 1
    next
  }
  was_blank = line == ""
  was_code = was_code && was_blank
  add(escaped(line))
  next
}
prologue { add("*/"); prologue = 0; next }
/^namespace / { is_public = group != "" && /^namespace weft(::IO)? \{/ }
{ add($0) }

END {
  for (i = 1; i <= n; ++i) {
    if (lines[i] == "" && in_public[i] && lines[i + 1] ~ /^\/\/\// && begins_class(i + 1))
      print "/// \\ingroup " group
    else
      print lines[i]
  }
}

function add(line) {
  lines[++n] = line
  in_public[n] = is_public
}

# Whether the comment at line k is that of a class, structure or enumeration.
function begins_class(k) {
  while (lines[k] ~ /^\/\/\//) ++k
  while (lines[k] ~ /^(template|  )/) ++k # a template's head, over several lines if need be
  return lines[k] ~ /^(class|struct|enum) /
}

# Outside of backticks, arrows and such are text, not HTML; "sec. 3" doesn't end a sentence.
function escaped(line,    parts, n, i, result) {
  n = split(line, parts, "`")
  for (i = 1; i <= n; ++i) {
    if (i % 2 == 1) {
      gsub(/</, "\\<", parts[i])
      gsub(/>/, "\\>", parts[i])
      gsub(/(sec|fig|Alg)\. /, "&\\ ", parts[i])
      gsub(/\. \\ /, ".\\ ", parts[i])
    }
    result = result (i > 1 ? "`" : "") parts[i]
  }
  return result
}
