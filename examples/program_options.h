// SPDX-License-Identifier: GPL-3.0-or-later
//
// Options that several of the command-line programs have, and what they check and say in the same way.

#ifndef WEFT_EXAMPLES_PROGRAM_OPTIONS_H
#define WEFT_EXAMPLES_PROGRAM_OPTIONS_H

#include "command_line.h"
#include "output_files.h"

#include <weft/IO/internal/Svg_canvas.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace command_line {

/// The files that a call names, and whether the program says how it goes.
struct Files
{
  std::vector<std::string> inputs, outputs;
  std::string histogram, report;
  bool quiet = false;

  /// For messages.
  std::string input() const { return inputs.size() == 1 ? inputs.front() : inputs.front() + " and others"; }
};

/// The formats of spatial meshes and how their files end, for people.
inline constexpr const char* spatial_formats =
    ".mesh (Medit),\n.vtu (VTK), .msh (Gmsh), .inp (Abaqus, CalculiX), or of the boundary alone .off or .stl";
inline constexpr const char* spatial_endings = ".mesh, .vtu, .msh, .inp, .off or .stl";

inline void add_outputs(Options& options, Files& files, const std::string& formats)
{
  options.texts("--output", "FILE", files.outputs,
                "the mesh; may be given several times. The extension is the format: " + formats);
}

inline void add_report(Options& options, Files& files, const std::string& help)
{
  options.filename("--report", ".json", files.report, help);
}

inline void add_histogram(Options& options, Files& files, const std::string& help)
{
  options.filename("--histogram", ".svg", files.histogram, help);
}

/// How many threads the machine runs at once.
inline int all_cores()
{
  return static_cast<int>((std::max)(1u, std::thread::hardware_concurrency()));
}

/// How a run begins and what it may use.
/// \param run the options of any of weft's entry points.
template <class Run_options>
void add_seed_threads_and_time(Options& options, Run_options& run)
{
  options.integer("--seed", "N", 0u, std::numeric_limits<unsigned>::max(), run.seed, "start of every random choice");
  options.integer("--threads", "N", 1, 1024, run.threads,
                  "threads to use (default " + std::to_string(run.threads) + "); the mesh is the same for any number");
  options.positive("--time-limit", "SECONDS", run.time_limit, "stop early after this time");
}

template <class Run_options>
void add_max_vertices(Options& options, Run_options& run)
{
  constexpr std::size_t most = 1000000000;
  options.integer("--max-vertices", "N", std::size_t(1), most, run.max_vertices,
                  "stop early at this number of vertices");
}

inline void add_quiet(Options& options, Files& files)
{
  options.flag("--quiet", files.quiet, "no progress and no report; errors are still said");
}

/// Values of which one may hold for all labels, and others for a single label each, given as LABEL:VALUE.
/// \param what the label is called.
/// \param read makes a value of a text.
/// \param take takes the general one.
template <class Value, class Read, class Take>
void read_by_label(const std::string& option, const std::string& what, const std::vector<std::string>& texts,
                   const Read& read, const Take& take, std::map<int, Value>& of_label)
{
  bool has_general = false;
  for (const std::string& text : texts) {
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos) {
      if (std::exchange(has_general, true)) throw Error(option + " is given twice");
      take(read(text));
    } else {
      const int label = read_integer(option, text.substr(0, colon));
      if (!of_label.emplace(label, read(text.substr(colon + 1))).second)
        throw Error(option + " is given twice for the " + what + " " + std::to_string(label));
    }
  }
}

/// The same for lengths.
inline void read_lengths(const std::string& option, const std::string& what, const std::vector<std::string>& texts,
                         bool may_be_zero, Length& general, std::map<int, Length>& of_label)
{
  read_by_label(
      option, what, texts, [&](const std::string& text) { return read_length(option, text, may_be_zero); },
      [&](const Length& length) { general = length; }, of_label);
}

/// Refuses calls without input, and outputs that can't be written.
/// \param is_mesh_filename whether a mesh can be written to a file of that name.
/// \param endings for people.
template <class Is_mesh_filename>
void check_files(const std::string& program, const Files& files, const Is_mesh_filename& is_mesh_filename,
                 const std::string& endings)
{
  if (files.inputs.empty()) throw Error("no input file; " + program + " --help shows the usage");
  for (const std::string& filename : files.outputs)
    if (!is_mesh_filename(filename)) throw Error("--output: '" + filename + "' should end in " + endings);
}

/// For programs that take a single file.
inline void check_single_input(const Files& files)
{
  if (files.inputs.size() > 1) throw Error("more than one input file: '" + files.inputs[1] + "'");
}

inline void announce(const Files& files, Output_files& output)
{
  for (const std::string& filename : files.outputs) output.announce(filename);
  for (const std::string& filename : {files.histogram, files.report})
    if (!filename.empty()) output.announce(filename);
}

// ---- What is missing

/// Appends a part to a list in a sentence; nothing if the part is empty.
inline void append_to_list(std::string& list, const std::string& part)
{
  if (!part.empty()) list += (list.empty() ? "" : ", ") + part;
}

/// "the smallest angle is 34.9 degrees, not 35.0".
/// \param smallest rounded down.
inline std::string too_small(const std::string& angle, double smallest, double asked)
{
  return "the smallest " + angle + " is " + weft::internal::one_decimal(std::floor(10 * smallest) / 10) +
         " degrees, not " + weft::internal::one_decimal(asked);
}

// ---- Smallest dihedral angles

/// Dihedral angle of regular tetrahedra, in degrees: no mesh has more, since they don't fill space.
constexpr double regular_dihedral = 70.53;

/// \param angle asked for, in degrees; 0: none. 90 goes as far as possible.
inline void check_min_dihedral(const Options& options, double angle)
{
  if (angle > regular_dihedral && angle < 90)
    throw Error("--min-dihedral: '" + options.value("--min-dihedral") +
                "' is more than regular tetrahedra have; 90 goes as far as possible");
}

/// "the smallest dihedral angle is 11.9 degrees, not 12.0", or nothing if it is as large as was asked for.
inline std::string missing_dihedral(double asked, double smallest)
{
  return smallest < asked && asked < regular_dihedral ? too_small("dihedral angle", smallest, asked) : "";
}

} // namespace command_line

#endif // WEFT_EXAMPLES_PROGRAM_OPTIONS_H
