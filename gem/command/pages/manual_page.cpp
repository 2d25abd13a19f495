// Writes the texts of --help as roff.
#include "gem/command/pages/manual_page.h"

#include <cctype>

namespace gem {
namespace {

/// Text of a paragraph: nothing in it is a request or an escape of roff. Words between backquotes are set bold.
std::string roff(const std::string& text) {
  std::string result;
  bool bold = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool line_starts = i == 0 || text[i - 1] == '\n';
    if (line_starts && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else if (c == '`')
      result += (bold = !bold) ? "\\fB" : "\\fR";
    else
      result += c;
  }
  return bold ? result + "\\fR" : result;
}

std::string argument_of(const OptionText& option) {
  return option.argument.empty() ? "" : " \\fI" + roff(option.argument) + "\\fR";
}

std::string option_roff(const OptionText& option) {
  std::string text = ".TP\n";
  for (std::size_t i = 0; i < option.names.size(); ++i)
    text += (i == 0 ? "" : ", ") + ((option.is_positional ? "\\fI" : "\\fB") + roff(option.names[i]) + "\\fR");
  text +=
      (option.is_positional ? (option.takes_many ? " ..." : "") : argument_of(option)) + "\n" + roff(option.meaning);
  if (!option.choices.empty()) {
    text += "; one of";
    for (std::size_t i = 0; i < option.choices.size(); ++i)
      text += (i == 0 ? " " : ", ") + ("\\fB" + roff(option.choices[i]) + "\\fR");
  }
  if (!option.preset.empty()) text += " [default: " + roff(option.preset) + "]";
  return text + "\n";
}

std::string synopsis(const std::string& name, const CommandText& command) {
  std::string text = "\\fB" + roff(name) + "\\fR";
  if (!command.options.empty()) text += " [\\fIoptions\\fR]";
  for (const OptionText& option : command.options) {
    if (!option.is_positional) continue;
    const std::string word = "\\fI" + roff(option.names.front()) + "\\fR" + (option.takes_many ? " ..." : "");
    text += option.is_required ? " " + word : " [" + word + "]";
  }
  return text;
}

std::string options_roff(const CommandText& command) {
  std::string text;
  for (const OptionText& option : command.options)
    if (option.names.back() != "--help" || command.path.empty()) text += option_roff(option);
  return text;
}

/// The section of a command, then those of its own commands.
std::string command_roff(const CommandText& command) {
  std::string text;
  if (command.commands.empty())
    text =
        ".SS " + synopsis("gem " + command.path, command) + "\n" + roff(command.meaning) + "\n" + options_roff(command);
  for (const CommandText& sub : command.commands) text += command_roff(sub);
  if (!command.footer.empty()) text += ".PP\n" + roff(command.footer) + "\n";
  return text;
}

std::string in_name_section(std::string sentence) {
  sentence.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(sentence.front())));
  if (sentence.back() == '.') sentence.pop_back();
  return sentence;
}

}  // namespace

std::string manual_page(const CommandText& program, const std::string& version) {
  std::string text = ".\\\" Made by `gem manual` from the text of --help.\n.TH GEM 1 \"\" \"gem " + roff(version) +
                     "\" \"User Commands\"\n.SH NAME\ngem \\- " + roff(in_name_section(program.meaning)) +
                     "\n.SH SYNOPSIS\n\\fBgem\\fR \\fIcommand\\fR [\\fIoptions\\fR]\n.SH OPTIONS\n" +
                     options_roff(program) + ".SH COMMANDS\n";
  for (const CommandText& command : program.commands) text += command_roff(command);
  return text + ".SH NOTES\n" + roff(program.footer) + "\n";
}

}  // namespace gem
