// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the programs that improve meshes have in common: the files they are asked for, and the run from reading a mesh
// to saying what is missing.

#ifndef WEFT_EXAMPLES_IMPROVE_PROGRAM_H
#define WEFT_EXAMPLES_IMPROVE_PROGRAM_H

#include "command_line.h"
#include "meshing_progress.h"

#include <weft/errors.h>
#include <weft/IO/write_angle_histogram_svg.h>
#include <weft/report.h>

#include <filesystem>
#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace improve_program {

using command_line::Error;
using command_line::Status;

/// The files that a call names.
struct Files
{
  std::string input;
  std::vector<std::string> outputs;
  std::string histogram, report;
  bool quiet = false;
};

/// \param is_mesh_filename whether a mesh can be written to a file of that name. \param endings for people.
template <class Is_mesh_filename>
void read_files(const command_line::Arguments& arguments, const std::string& program,
                const Is_mesh_filename& is_mesh_filename, const std::string& endings, Files& files)
{
  if (arguments.operands().empty()) throw Error("no input file; " + program + " --help shows the usage");
  if (arguments.operands().size() > 1) throw Error("more than one input file: '" + arguments.operands()[1] + "'");
  files.input = arguments.operands().front();
  files.outputs = arguments.values("--output");
  for (const std::string& filename : files.outputs)
    if (!is_mesh_filename(filename)) throw Error("--output: '" + filename + "' should end in " + endings);
  files.histogram = arguments.filename("--histogram", ".svg");
  files.report = arguments.filename("--report", ".json");
  files.quiet = arguments.has("--quiet");
}

/// Whether the boundary stays as it is. \param for_sliding options that make no sense then.
inline bool read_boundary_is_fixed(const command_line::Arguments& arguments,
                                   const std::vector<std::string>& for_sliding)
{
  const std::string boundary = arguments.value("--boundary");
  if (!boundary.empty() && boundary != "slide" && boundary != "fixed")
    throw Error("--boundary: '" + boundary + "' is neither slide nor fixed");
  if (boundary != "fixed") return false;
  for (const std::string& option : for_sliding)
    if (arguments.has(option)) throw Error(option + " is for boundaries that slide");
  return true;
}

/// What is missing, with the reason where a run stopped before its end.
inline std::string with_stop_reason(weft::Stop_reason reason, const std::string& missing)
{
  if (reason == weft::Stop_reason::criteria_met || reason == weft::Stop_reason::exhausted) return missing;
  return std::string("stopped early, ") + name(reason) + (missing.empty() ? "" : ": ") + missing;
}

/// Improves, writes all files and tells how it went.
/// \param read from a filename to a mesh and notes.
/// \param improve from a mesh and a visitor to a mesh and a report. \param advice for input that it refuses.
/// \param write_mesh,write_report to a filename. \param missing what a report falls short of, as one line, or nothing.
/// \param title of the histogram.
template <class Read, class Improve, class Write_mesh, class Write_report, class Missing>
Status run(const std::string& program, const Files& files, const Read& read, const Improve& improve,
           const std::string& advice, const Write_mesh& write_mesh, const Write_report& write_report,
           const Missing& missing, const std::string& title)
{
  const auto note = [&](const std::string& text) {
    if (!files.quiet) command_line::complain(program, files.input + ": " + text);
  };
  command_line::Output_files output;
  const auto input = read(files.input);
  for (const std::string& text : input.notes) note(text);
  for (const std::string& filename : files.outputs) output.announce(filename);
  for (const std::string& filename : {files.histogram, files.report})
    if (!filename.empty()) output.announce(filename);

  const command_line::Interruption interruption;
  Meshing_progress progress(!files.quiet, 0.1);
  const auto [mesh, report] = [&, &source = input.mesh] {
    try {
      return improve(source, std::ref(progress));
    } catch (const weft::Domain_error& error) {
      throw Error(files.input + ": " + error.what() + advice);
    }
  }();
  progress.bar().clear();
  for (const std::string& text : report.notes) note(text);

  for (const std::string& filename : files.outputs)
    output.add(filename, [&m = mesh, &write_mesh](const std::string& name) { write_mesh(name, m); });
  if (!files.report.empty())
    output.add(files.report, [&r = report, &write_report](const std::string& name) { write_report(name, r); });
  if (!files.histogram.empty())
    output.add(files.histogram, [&r = report, &files, &title](const std::string& name) {
      weft::IO::write_angle_histogram_svg(name, r.after.template histogram<weft::Angle_histogram>("after"),
                                          r.before.template histogram<weft::Angle_histogram>("before"),
                                          title + ": " + std::filesystem::path(files.input).filename().string());
    });
  output.commit();
  if (!files.quiet) std::cout << report << std::flush;
  const std::string what = missing(report);
  if (!what.empty()) command_line::complain(program, what);
  return what.empty() ? command_line::complete : command_line::stopped_early;
}

} // namespace improve_program

#endif // WEFT_EXAMPLES_IMPROVE_PROGRAM_H
