# Marks plain comments for Doxygen: the first comment block becomes the text of the file, verbatim, and `// ...` after a member
# becomes the text of that member.
FNR == 1 { opening = 1 }
opening && /^\/\// {
  if (!opened++) print "/** \\file\n\\verbatim"
  line = substr($0, 4)
  gsub(/\*\//, "* /", line)
  print line
  next
}
opening {
  if (opened) print "\\endverbatim */"
  opening = 0
}
/^  [^(){}\/]*;  +\/\/ / { sub(/;  +\/\/ /, ";  ///< ") }
{ print }
