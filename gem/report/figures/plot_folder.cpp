// Writes gnuplot scripts in one style, runs gnuplot, and prepares the pictures for one page.
#include "gem/report/figures/plot_folder.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "gem/base/error.h"
#include "gem/report/figures/run_program.h"
#include "gem/report/plain_text.h"

namespace gem {
namespace {

// Plain axes, a light grid, the palette viridis; ls 1-4 are the colours of lines on white.
constexpr const char* kPlotStyle = R"(set encoding utf8
set datafile separator ','
set datafile columnheaders
set key noautotitle
set border 3 lc rgb '#8a8f98' lw 1
set tics nomirror out scale 0.5 font ',12' textcolor rgb '#3c4149'
set xtics offset 0,0.3
set format '%g'
set grid xtics ytics back lc rgb '#e6e8eb' lw 1 dt solid
set key outside top left horizontal Left reverse width 1 samplen 1.6 spacing 1.15 textcolor rgb '#3c4149'
set lmargin 11
set rmargin 3
set tmargin 2
set style line 1 lc rgb '#31688e' lw 1.2
set style line 2 lc rgb '#c2571a' lw 1.4
set style line 3 lc rgb '#35a37a' lw 1.2
set style line 4 lc rgb '#8a8f98' lw 1.0
set style fill solid 1.0 noborder
set palette defined (0 '#440154', 1 '#482878', 2 '#3e4989', 3 '#31688e', 4 '#26828e', 5 '#1f9e89', 6 '#35b779', 7 '#6ece58', 8 '#b5de2b', 9 '#fde725')
)";

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  std::string result;
  std::size_t done = 0;
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, done)) {
    result.append(text, done, at - done).append(to);
    done = at + from.size();
  }
  text = result.append(text, done, std::string::npos);
}

void remove_between(std::string& text, const std::string& open, const std::string& close) {
  std::string result;
  std::size_t done = 0;
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, done)) {
    const std::size_t end = text.find(close, at + open.size());
    if (end == std::string::npos) break;
    result.append(text, done, at - done);
    done = end + close.size();
  }
  text = result.append(text, done, std::string::npos);
}

/// Makes several pictures fit for one page: no XML prologue, no tooltips, unique symbol names.
std::string tidy_svg(std::string svg, const Figure& figure) {
  svg.erase(0, svg.find("<svg"));
  remove_between(svg, "<title>", "</title>");
  remove_between(svg, "<desc>", "</desc>");
  remove_between(svg, " id=\"gnuplot_plot_", "\"");
  replace_all(svg, "id='gp", "id='" + figure.name + "-gp");
  replace_all(svg, "#gp", "#" + figure.name + "-gp");
  return svg;
}

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

Error no_gnuplot() {
  return {ExitCode::file_system,
          "gnuplot was not found (the figures of a report need it); install the package gnuplot-nox"};
}

}  // namespace

void Csv::row(const std::vector<double>& values) {
  char buffer[32];
  const char* separator = "";
  for (const double value : values) {
    text_ += separator;
    separator = ",";
    // Seven digits are enough for a picture. An empty field is a gap for gnuplot.
    if (std::isfinite(value))
      text_.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 7).ptr);
  }
  text_ += '\n';
}

PlotFolder::PlotFolder(std::filesystem::path folder, std::string stamp)
    : folder_(std::move(folder)), stamp_(std::move(stamp)) {
  // Checked before anything is written.
  if (!run_program({"gnuplot", "--version"}, ".").found) throw no_gnuplot();
  std::error_code failed;
  std::filesystem::create_directories(folder_, failed);
  if (failed)
    throw Error(ExitCode::file_system, "cannot make the folder " + folder_.string() + " (" + failed.message() +
                                           "); choose another output folder");
}

void PlotFolder::write(const std::string& file, const std::string& text) const {
  std::ofstream stream(folder_ / file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream)
    throw Error(ExitCode::file_system,
                "cannot write " + (folder_ / file).string() + " (disk full or no permission); choose another folder");
}

void PlotFolder::write_csv(const std::string& name, const Csv& csv) const { write(name + ".csv", csv.text()); }

Figure PlotFolder::draw(Figure figure, PlotSize size, const std::string& commands) const {
  std::ostringstream script;
  script << "# " << figure.title << ". Redraw: gnuplot -d " << figure.name << ".gp\n"
         << "set terminal svg size " << size.width << ',' << size.height
         << " dynamic noenhanced font 'sans-serif,14' background '#ffffff'\n"
         << "set output " << quoted(figure.name + ".svg") << '\n'
         << kPlotStyle << "set label 99 " << quoted(stamp_)
         << " at screen 0.995, graph 1.0 right offset 0,0.9 font ',9' textcolor rgb '#9aa0a8' noenhanced front\n"
         << commands;
  write(figure.name + ".gp", script.str());
  const ProgramResult result = run_program({"gnuplot", "-d", figure.name + ".gp"}, folder_);
  if (!result.found) throw no_gnuplot();
  if (result.exit_code != 0)
    throw Error(ExitCode::file_system, "gnuplot failed on " + (folder_ / (figure.name + ".gp")).string() + " (" +
                                           result.output + "); run it by hand to see more");
  figure.svg = tidy_svg(read(folder_ / (figure.name + ".svg")), figure);
  return figure;
}

// Between single quotes gnuplot knows no escapes and runs nothing. Only the quote itself and the end of the line end
// the text, and neither is left in it. A doubled quote would not do: at the start of a text it ends an empty one.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : plain_text(text))
    if (c == '\'')
      result += "\u2019";
    else if (c == '`')
      result += "\u2018";
    else
      result += c;
  return result + "'";
}

}  // namespace gem
