// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the programs that improve meshes have in common: the run from reading a mesh to saying what is missing.

#ifndef WEFT_EXAMPLES_IMPROVE_PROGRAM_H
#define WEFT_EXAMPLES_IMPROVE_PROGRAM_H

#include "interruption.h"
#include "meshing_progress.h"
#include "output_files.h"
#include "program_options.h"

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

/// Whether the boundary stays as it is.
/// \param boundary slide, fixed or empty.
/// \param for_sliding options that make no sense then.
inline bool is_boundary_fixed(const command_line::Options& options, const std::string& boundary,
                              const std::vector<std::string>& for_sliding)
{
  if (!boundary.empty() && boundary != "slide" && boundary != "fixed")
    throw Error("--boundary: '" + boundary + "' is neither slide nor fixed");
  if (boundary != "fixed") return false;
  for (const std::string& option : for_sliding)
    if (options.has(option)) throw Error(option + " is for boundaries that slide");
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
/// \param improve from a mesh and a visitor to a mesh and a report.
/// \param advice for input that it refuses.
/// \param write_mesh,write_report to a filename.
/// \param missing what a report falls short of, as one line, or nothing.
/// \param title of the histogram.
template <class Read, class Improve, class Write_mesh, class Write_report, class Missing>
Status run(const std::string& program, const command_line::Files& files, const Read& read, const Improve& improve,
           const std::string& advice, const Write_mesh& write_mesh, const Write_report& write_report,
           const Missing& missing, const std::string& title)
{
  const std::string& filename = files.inputs.front();
  const auto note = [&](const std::string& text) {
    if (!files.quiet) command_line::complain(program, filename + ": " + text);
  };
  command_line::Output_files output;
  const auto input = read(filename);
  for (const std::string& text : input.notes) note(text);
  announce(files, output);

  const command_line::Interruption interruption;
  Meshing_progress progress(!files.quiet, 0.1);
  const auto [mesh, report] = [&, &source = input.mesh] {
    try {
      return improve(source, std::ref(progress));
    } catch (const weft::Domain_error& error) {
      throw Error(filename + ": " + error.what() + advice);
    }
  }();
  progress.bar().clear();
  for (const std::string& text : report.notes) note(text);

  for (const std::string& wanted : files.outputs)
    output.add(wanted, [&m = mesh, &write_mesh](const std::string& name) { write_mesh(name, m); });
  if (!files.report.empty())
    output.add(files.report, [&r = report, &write_report](const std::string& name) { write_report(name, r); });
  if (!files.histogram.empty())
    output.add(files.histogram, [&r = report, &filename, &title](const std::string& name) {
      weft::IO::write_angle_histogram_svg(name, r.after.template histogram<weft::Angle_histogram>("after"),
                                          r.before.template histogram<weft::Angle_histogram>("before"),
                                          title + ": " + std::filesystem::path(filename).filename().string());
    });
  output.commit();
  if (!files.quiet) std::cout << report << std::flush;
  const std::string what = missing(report);
  if (!what.empty()) command_line::complain(program, what);
  return what.empty() ? command_line::complete : command_line::stopped_early;
}

} // namespace improve_program

#endif // WEFT_EXAMPLES_IMPROVE_PROGRAM_H
