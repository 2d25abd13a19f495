// Writes an HDF5 file from a description in lines of text, so that seeds of the run file and summary readers can be
// read, and a mutated seed is still a sound HDF5 file with other content.
#pragma once

#include <cstdint>
#include <string>

namespace gem::test {

/// Writes the file. One line makes one thing; a line that makes no sense is left out. The schema of
/// run files is there from the start. PATH is that of a dataset, or
/// `/`.
///   text PATH NAME words to the end of the line     an attribute; \n stands for a line break
///   texts PATH NAME first | second                  an attribute of several texts
///   number PATH NAME 1 2 nan                        an attribute: one number or a list
///   data PATH f8 3 2 = 0 1.5                        a dataset of 3 x 2 (types f4 f8 i4 u1); values continue evenly
///   data PATH f8 4000000000                         without values nothing is stored, whatever the size
///   strings PATH first | second                     a dataset of texts of any length
///   fixed PATH first | second                       a dataset of texts of one length
///   scale PATH                                      makes a dataset a dimension scale
///   attach PATH 1 SCALE                             gives dimension 1 of a dataset its scale
void write_described_file(const std::string& description, const std::string& path);

/// Number of files, datasets, groups, types and attributes that the HDF5 library holds open.
std::int64_t open_hdf5_objects();

/// Closes all of them.
void close_hdf5_objects();

}  // namespace gem::test
