# SPDX-License-Identifier: GPL-3.0-or-later
#
# Makes of rooms.txt what the manual has besides the sources: a sentence for each folder, a group for each room with
# public headers, the rooms to start from first (filter_header.awk puts classes in), and a page for each example program
# with its opening comment.
#
#   awk -f filter_rooms.awk doc/rooms.txt

BEGIN {
  root = ARGV[1]
  if (!sub(/doc\/rooms\.txt$/, "", root)) exit
  add_folder("doc", "The manual's own classes.")
  add_folder("doc/concepts", "What types of your own have to offer, as classes.")
  add_folder("include/weft", "The library; the headers to start from stand in the folder itself.")
  add_folder("include/weft/planar", "In the plane.")
  add_folder("include/weft/spatial", "In space.")
}

/^(#|$)/ { next }
/^\+ / { is_public[rooms] = 1; next }
{
  name[++rooms] = substr($0, 1, index($0, ": ") - 1)
  sentence[rooms] = toupper(substr($0, length(name[rooms]) + 3, 1)) substr($0, length(name[rooms]) + 4) "."
}

END {
  for (r = rooms; r > 0; --r)
    if (is_public[r] && name[r] ~ /^\[/) add_room(r)
  for (r = rooms; r > 0; --r)
    if (is_public[r] && name[r] !~ /^\[/) add_room(r)
  command = "LC_ALL=C ls '" root "examples/'*.cpp"
  while ((command | getline file) > 0) add_example(file)
}

function add_room(r,    group, title) {
  group = name[r]
  gsub(/[^A-Za-z0-9]+/, "_", group)
  sub(/^_/, "", group)
  sub(/_$/, "", group)
  title = name[r]
  gsub(/[][]/, "", title)
  print "/*! \\defgroup room_" group " " title "\n\\brief " sentence[r] " */"
  if (name[r] !~ /^\[/) add_folder("include/weft/" name[r], sentence[r])
}

function add_folder(path, text) { print "/*! \\dir " root path "/\n\\brief " text " */" }

function add_example(file,    line, number) {
  line = file
  sub(/.*\//, "", line)
  print "/*! \\example " line
  while ((getline line < file) > 0 && line ~ /^\/\//)
    if (++number > 2) print substr(line, 4)
  print "*/"
  close(file)
}
