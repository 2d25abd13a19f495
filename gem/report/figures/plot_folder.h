// A folder of figures: for each the data (CSV), the gnuplot script and the picture (SVG).
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace gem {

/// Rows of numbers under a header; blank lines separate outlines.
class Csv {
 public:
  explicit Csv(const std::string& header) : text_(header + "\n") {}
  void row(const std::vector<double>& values);
  void row(std::initializer_list<double> values) { row(std::vector<double>(values)); }
  void gap() { text_ += "\n"; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// A finished figure for the page.
struct Figure {
  std::string name;     // of its files
  std::string title;    // the alternative text of the picture
  std::string caption;  // HTML
  std::string svg;
};

struct PlotSize {
  int width = 1000;
  int height = 300;
};

class PlotFolder {
 public:
  /// Makes the folder. `stamp` (case and commit) is printed small on every figure. Throws Error(file_system) if gnuplot
  /// is missing or the folder cannot be made.
  PlotFolder(std::filesystem::path folder, std::string stamp);
  void write_csv(const std::string& name, const Csv& csv) const;
  /// Writes NAME.gp, runs gnuplot on it and returns the picture. `commands` may use the line styles and the palette of
  /// the common style. Throws Error(file_system) if gnuplot is missing or fails, or a file cannot be written.
  Figure draw(Figure figure, PlotSize size, const std::string& commands) const;

 private:
  void write(const std::string& file, const std::string& text) const;
  std::filesystem::path folder_;
  std::string stamp_;
};

/// Any text as a text of a gnuplot script, on one line between single quotes. Quotes in it become typographic ones.
std::string quoted(const std::string& text);

}  // namespace gem
