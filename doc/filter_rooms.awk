# SPDX-License-Identifier: GPL-3.0-or-later
#
# Makes of rooms.txt what the manual has besides the sources: a sentence for each folder of headers, a group for each
# folder with public classes (filter_header.awk puts them in), and a page for each example program, with its opening
# comment.
#
#   awk -f filter_rooms.awk doc/rooms.txt

BEGIN {
  root = ARGV[1]
  if (!sub(/doc\/rooms\.txt$/, "", root)) exit
  print "/*! \\dir " root "doc/\n\\brief The manual's own classes. */"
  print "/*! \\dir " root "doc/concepts/\n\\brief What types of your own have to offer, as classes. */"
}

/^#/ || split($0, field, / \| /) < 3 { next }
{
  known[field[1]] = 1
  add_room(field[1], field[2], field[3])
}

END {
  command = "cd '" root "include/weft' && find . -mindepth 1 -type d ! -path '*internal*' | LC_ALL=C sort"
  while ((command | getline folder) > 0) {
    sub(/^\.\//, "", folder)
    if (!(folder in known)) add_room(folder, folder, "-") # check_documented.cmake complains
  }
  command = "LC_ALL=C ls '" root "examples/'*.cpp"
  while ((command | getline file) > 0) add_example(file)
}

function add_room(folder, title, sentence,    path, group) {
  path = root "include/weft/" (folder == "." ? "" : folder "/")
  if (system("test -d '" path "'")) return
  print "/*! \\dir " path "\n\\brief " sentence " */"
  if (system("grep -Eqs '^namespace weft(::IO)? [{]' '" path "'*.h")) return
  group = folder == "." ? "start" : folder
  gsub(/[^A-Za-z0-9]/, "_", group)
  print "/*! \\defgroup room_" group " " title "\n\\brief " sentence " */"
}

function add_example(file,    line, number) {
  line = file
  sub(/.*\//, "", line)
  print "/*! \\example " line
  while ((getline line < file) > 0 && line ~ /^\/\//)
    if (++number > 2) print substr(line, 4)
  print "*/"
  close(file)
}
