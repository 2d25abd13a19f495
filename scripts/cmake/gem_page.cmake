# Embeds the page of gem view in the program: cmake -DSOURCE_DIR=gem/view/page -DOUTPUT=file.cpp -P gem_page.cmake
# The modules become one script, in the order of page/modules.txt: imports are left out, and exported names are simply names.
file(STRINGS ${SOURCE_DIR}/modules.txt modules)
file(READ ${SOURCE_DIR}/uplot/uPlot.iife.min.js script)
file(READ ${SOURCE_DIR}/uplot/LICENSE licence)
string(PREPEND script "/*! uPlot 1.6.32\n${licence}*/\n")
foreach(module IN LISTS modules)
  file(READ ${SOURCE_DIR}/${module} text)
  string(REGEX REPLACE "(^|\n)import [^\n]*" "\\1" text "${text}")
  string(REGEX REPLACE "(^|\n)export " "\\1" text "${text}")
  string(APPEND script "\n// ${module}\n${text}")
endforeach()
file(READ ${SOURCE_DIR}/uplot/uPlot.min.css style)
file(READ ${SOURCE_DIR}/page.css own_style)
file(READ ${SOURCE_DIR}/page.html html)

# A literal holds at most 65,535 bytes by the standard, so a long text is several.
function(literal out text)
  string(LENGTH "${text}" length)
  set(at 0)
  set(parts "")
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} 15000 part)
    string(APPEND parts "R\"gem_page(${part})gem_page\"\n")
    math(EXPR at "${at} + 15000")
  endwhile()
  set(${out} "${parts}" PARENT_SCOPE)
endfunction()
literal(html "${html}")
literal(style "${style}\n${own_style}")
literal(script "\n(() => {\n'use strict';\n${script}\n})();\n")
file(WRITE ${OUTPUT} "// Made by gem_page.cmake of gem/view/page.
#include \"gem/view/page_text.h\"

namespace gem::view {
const std::string page_html = ${html};
const std::string page_style = ${style};
const std::string page_script = ${script};
}  // namespace gem::view
")
