// Fuzz target: the summary of a sweep.
#include "gem/fuzz/target.h"
#include "gem/record/summary/summary_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = gem::fuzz::hdf5_input("summary.h5", gem::fuzz::text_of(data, size));
  gem::SummaryTable table;
  if (!gem::fuzz::accepted([&] { table = gem::read_summary(path); })) return 0;
  gem::fuzz::expect(gem::is_summary(path), "a summary that can be read is not called one");
  for (const gem::SummaryColumn& column : table.columns)
    gem::fuzz::expect(column.numbers.size() + column.texts.size() == table.runs.size(), "a column of another length");
  for (const gem::SummarySeries& series : table.series)
    gem::fuzz::expect(table.axis(series.axis) != nullptr, "a series without its axis");
  return 0;
}
