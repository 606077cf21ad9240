# SPDX-License-Identifier: GPL-3.0-or-later
#
# Shows Doxygen pages that are written for GitHub: headings get the identifiers that GitHub gives them, prefixed with
# the name of the page so that they are unique; links to pages, headings and images of the manual become Doxygen's, links
# to other files of the repository become text; the numbered list in README.md makes pages subpages of it. Each page has
# its contents after the title, in place of the empty line there.
#
#   awk -f filter_markdown.awk PAGE

BEGIN {
  page = ARGV[1]
  sub(/.*\//, "", page)
  sub(/\.md$/, "", page)
}

FNR == 1 && /^<!--.*-->$/ { print ""; next } # a page begins with its title

/^```/ { in_code = !in_code; print; next }
in_code { print; next }

/^# / && !titled {
  titled = 1
  print $0 (page == "README" ? "" : " {#" page "}")
  next
}
titled && !has_contents {
  has_contents = 1
  if ($0 == "") {
    print "[TOC]"
    next
  }
}
/^##+ / { print $0 " {#" page "_" slug($0) "}"; next }
{
  lists_pages = page == "README" && /^[0-9]+\. \[/
  print with_links($0)
}

# As GitHub: lower case, spaces to hyphens, punctuation left out.
function slug(heading) {
  sub(/^#+ +/, "", heading)
  heading = tolower(heading)
  gsub(/[^a-z0-9 _-]/, "", heading)
  gsub(/ /, "-", heading)
  return heading
}

function with_links(line,    result, text, target, before, image) {
  while (match(line, /!?\[[^\]]*\]\([^)]*\)/)) {
    before = substr(line, 1, RSTART - 1)
    text = substr(line, RSTART, RLENGTH)
    line = substr(line, RSTART + RLENGTH)
    image = text ~ /^!/
    target = text
    sub(/^!?\[[^\]]*\]\(/, "", target)
    sub(/\)$/, "", target)
    sub(/\]\([^)]*\)$/, "", text)
    sub(/^!?\[/, "", text)
    result = result before converted(text, target, image)
  }
  return result line
}

function converted(text, target, image,    file, heading) {
  if (image) return "![" text "](" target ")"
  if (target ~ /^[a-z]+:/) return "[" text "](" target ")"
  if (target ~ /^concepts\/.*\.h$/) return "@ref concepts::" text " \"" text "\""
  file = target
  sub(/#.*/, "", file)
  heading = index(target, "#") ? substr(target, index(target, "#") + 1) : ""
  if (file != "" && (file !~ /^[a-zA-Z0-9_]+\.md$/)) return text
  sub(/\.md$/, "", file)
  if (file == "") file = page
  if (heading != "") return "[" text "](@ref " file "_" heading ")"
  if (lists_pages) return "@subpage " file " \"" text "\""
  return "[" text "](@ref " file ")"
}
