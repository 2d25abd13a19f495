# Marks plain comments for Doxygen: the block that opens a file becomes the file's text as it stands, and `// ...` behind a
# member becomes that member's text.
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
