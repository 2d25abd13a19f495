// Writes one case of bash per command and per option with known values.
#include "gem/command/pages/completion.h"

namespace gem {
namespace {

// The words before the cursor give the command; the word before it may be an option that takes a value. What is not
// completed here falls back to file names (`complete -o default`).
constexpr const char* kStart = R"(# Completion of gem for bash, made by `gem completion`.
_gem() {
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} command= next i words= values=
  # bash splits --option=value at the sign
  if [[ $word == = ]]; then word=; elif [[ $previous == = ]]; then previous=${COMP_WORDS[COMP_CWORD-2]}; fi
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; i++)); do
    next="${command:+$command }${COMP_WORDS[i]}"
    case $next in
)";

constexpr const char* kEnd = R"(  esac
  case $values in
    '') if [[ $word == -* || $commands ]]; then COMPREPLY=($(compgen -W "$words" -- "$word")); fi ;;
    @file) ;;
    @run) compopt -o filenames; mapfile -t COMPREPLY < <(compgen -f -X '!*.h5' -- "$word"; compgen -d -- "$word") ;;
    @key) compopt -o nospace; COMPREPLY=($(compgen -W "$keys" -S = -- "$word")) ;;
    @topic) COMPREPLY=($(compgen -W "$topics" -- "$word")) ;;
    *) COMPREPLY=($(compgen -W "$values" -- "$word")) ;;
  esac
}
complete -o bashdefault -o default -F _gem gem
)";

std::string joined_by(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

void add_paths(const CommandText& command, std::vector<std::string>& paths) {
  for (const CommandText& sub : command.commands) {
    paths.push_back("'" + sub.path + "'");
    add_paths(sub, paths);
  }
}

/// What stands for the values of an option or argument.
std::string values_of(const OptionText& option) {
  if (!option.choices.empty()) return joined_by(option.choices, " ");
  if (option.names.back() == "--set") return "@key";
  if (option.argument == "KEY") return "@topic";
  return option.argument == "RUNFILE" ? "@run" : "@file";
}

/// The words of a command, and the values of its options and arguments.
void add_cases(const CommandText& command, std::string& words, std::string& values) {
  std::vector<std::string> names;
  for (const CommandText& sub : command.commands) names.push_back(sub.path.substr(sub.path.rfind(' ') + 1));
  std::string positional;
  for (const OptionText& option : command.options) {
    if (option.is_positional) {
      positional = values_of(option);
      continue;
    }
    names.insert(names.end(), option.names.begin(), option.names.end());
    if (option.argument.empty()) continue;
    for (const std::string& name : option.names)
      values += "    '" + command.path + " " + name + "') values='" + values_of(option) + "' ;;\n";
  }
  if (!positional.empty())
    values += "    '" + command.path + " '*) [[ $word == -* ]] || values='" + positional + "' ;;\n";
  words += "    '" + command.path + "') words='" + joined_by(names, " ") + "'" +
           (command.commands.empty() ? "" : " commands=1") + " ;;\n";
  for (const CommandText& sub : command.commands) add_cases(sub, words, values);
}

}  // namespace

std::string bash_completion(const CommandText& program, const std::vector<std::string>& keys,
                            const std::vector<std::string>& topics) {
  std::vector<std::string> paths;
  add_paths(program, paths);
  std::string words, values;
  add_cases(program, words, values);
  return kStart +
         ("      " + joined_by(paths, "|") + ") command=$next ;;\n    esac\n  done\n  local commands= keys='") +
         joined_by(keys, " ") + "' topics='" + joined_by(topics, " ") + "'\n  case $command in\n" + words +
         "  esac\n  case \"$command $previous\" in\n" + values + kEnd;
}

}  // namespace gem
