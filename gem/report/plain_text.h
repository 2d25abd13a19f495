// Texts of run files, which may come from anybody, made fit for pictures and pages.
#pragma once

#include <string>

namespace gem {

/// The text on one line: control characters become blanks, bytes that are not UTF-8 become question marks, and the rest
/// after 2000 bytes is left out. Every text of a run file passes here before it is put into a script or a page.
std::string plain_text(const std::string& text);

}  // namespace gem
