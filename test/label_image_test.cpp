// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of reading labelled images: voxels, spacing and place are those of the file, whatever its type, and what
// can't be read is refused.

#include <weft/IO/read_label_image.h>

#include <catch2/catch.hpp>

#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;

/// A file that goes with the test case.
struct File
{
  std::string name;

  File(const std::string& name_, const std::string& bytes)
      : name((std::filesystem::temp_directory_path() / ("weft_label_image_test_" + name_)).string())
  {
    std::ofstream(name, std::ios::binary) << bytes;
  }
  ~File() { std::filesystem::remove(name); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
};

std::string error_of(const std::string& filename)
{
  try {
    weft::IO::read_label_image(filename);
  } catch (const weft::Error& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/// 2 x 3 x 4 voxels, three labels.
std::vector<int> voxels()
{
  std::vector<int> values(24, 0);
  values[0] = 5;                 // at (0, 0, 0)
  values[1] = 9;                 // at (1, 0, 0)
  values[2 * (2 + 3 * 3)] = 200; // at (0, 2, 3)
  return values;
}

void check_voxels(const weft::Label_image_3& image, const std::array<double, 3>& origin)
{
  CHECK(image.size() == std::array<std::size_t, 3>{{2, 3, 4}});
  REQUIRE(image.number_of_labels() == 4);
  CHECK(image.value(1) == 5);
  CHECK(image.value(3) == 200);
  const auto at = [&](int x, int y, int z) {
    return image(Point(origin[0] + 0.5 * x, origin[1] + 1.5 * y, origin[2] + 2 * z));
  };
  CHECK(at(0, 0, 0) == 1);
  CHECK(at(1, 0, 0) == 2);
  CHECK(at(0, 2, 3) == 3);
  CHECK(at(0, 1, 0) == 0);
}

/// An INRIMAGE file of the voxels, one byte each.
std::string inr()
{
  std::string header = "#INRIMAGE-4#{\nXDIM=2\nYDIM=3\nZDIM=4\nVDIM=1\nTYPE=unsigned fixed\nPIXSIZE=8 bits\n"
                       "SCALE=2**0\nCPU=decm\nVX=0.5\nVY=1.5\nVZ=2\n";
  header += std::string(256 - 4 - header.size(), '\n') + "##}\n";
  for (const int value : voxels()) header += static_cast<char>(value);
  return header;
}

#ifdef WEFT_LINKED_WITH_NIFTI

/// What a NIfTI-1 header says, at its place in the 348 bytes.
class Nifti
{
public:
  Nifti(int datatype, int bits) : bytes_(352, '\0')
  {
    put<std::int32_t>(0, 348);
    const std::int16_t dimensions[8] = {3, 2, 3, 4, 1, 1, 1, 1};
    for (std::size_t i = 0; i < 8; ++i) put(40 + 2 * i, dimensions[i]);
    put(70, static_cast<std::int16_t>(datatype));
    put(72, static_cast<std::int16_t>(bits));
    const float spacing[4] = {1, 0.5f, 1.5f, 2};
    for (std::size_t i = 0; i < 4; ++i) put(76 + 4 * i, spacing[i]);
    put<float>(108, 352); // where the voxels begin
    std::memcpy(&bytes_[344], "n+1", 4);
  }
  template <class Number>
  void put(std::size_t at, Number number)
  {
    std::memcpy(&bytes_[at], &number, sizeof number);
  }
  /// The rows of the matrix that gives scanner coordinates.
  void set_rows(const std::array<std::array<float, 4>, 3>& rows)
  {
    put<std::int16_t>(254, 1);
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 4; ++c) put(280 + 16 * r + 4 * c, rows[r][c]);
  }
  template <class Number>
  std::string with(const std::vector<int>& values, double offset = 0) const
  {
    std::string result = bytes_;
    for (const int value : values) {
      const auto number = static_cast<Number>(value + offset);
      result.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    return result;
  }

private:
  std::string bytes_;
};

#endif

} // namespace

TEST_CASE("INRIMAGE files are read with their spacing")
{
  const File file("a.inr", inr());
  check_voxels(weft::IO::read_label_image(file.name), {{0, 0, 0}});
}

TEST_CASE("file names say what is an image")
{
  for (const std::string name : {"a.inr", "a.inr.gz", "a.hdr", "a.nii", "a.nii.gz", "A.NII"})
    CHECK(weft::IO::is_label_image_filename(name));
  for (const std::string name : {"a.off", "nii", "a.gz", "a.nii.off"}) CHECK(!weft::IO::is_label_image_filename(name));
  CHECK(contains(error_of("missing.nii"), "can't be opened"));
  CHECK(contains(error_of("missing.inr"), "can't be opened"));
}

#ifdef WEFT_LINKED_WITH_NIFTI

TEST_CASE("NIfTI images of all types of integers, and of floating point numbers that are integers, are read")
{
  const auto check = [](const std::string& bytes) {
    const File file("b.nii", bytes);
    check_voxels(weft::IO::read_label_image(file.name), {{0, 0, 0}});
  };
  check(Nifti(2, 8).with<std::uint8_t>(voxels()));
  check(Nifti(4, 16).with<std::int16_t>(voxels()));
  check(Nifti(512, 16).with<std::uint16_t>(voxels()));
  check(Nifti(8, 32).with<std::int32_t>(voxels()));
  check(Nifti(16, 32).with<float>(voxels()));
  check(Nifti(64, 64).with<double>(voxels()));
  Nifti scaled(4, 16);
  scaled.put(112, 1.f);
  scaled.put(116, -3.f); // slope and offset
  check(scaled.with<std::int16_t>(voxels(), 3));
}

TEST_CASE("compressed NIfTI images are read")
{
  const File file("c.nii", Nifti(2, 8).with<std::uint8_t>(voxels()));
  if (std::system(("gzip -c '" + file.name + "' > '" + file.name + ".gz'").c_str()) != 0) return; // there is no gzip
  check_voxels(weft::IO::read_label_image(file.name + ".gz"), {{0, 0, 0}});
  std::filesystem::remove(file.name + ".gz");
}

TEST_CASE("NIfTI images are placed in scanner coordinates unless their axes are turned")
{
  Nifti nifti(2, 8);
  nifti.set_rows({{{{0.5f, 0, 0, 10}}, {{0, 1.5f, 0, -20}}, {{0, 0, 2, 30}}}});
  const File placed("d.nii", nifti.with<std::uint8_t>(voxels()));
  check_voxels(weft::IO::read_label_image(placed.name), {{10, -20, 30}});
  // x falls along the rows: the first voxel has the largest.
  nifti.set_rows({{{{-0.5f, 0, 0, 10}}, {{0, 1.5f, 0, -20}}, {{0, 0, 2, 30}}}});
  const File reversed("e.nii", nifti.with<std::uint8_t>(voxels()));
  const auto image = weft::IO::read_label_image(reversed.name);
  CHECK(image(Point(10, -20, 30)) == 1);
  CHECK(image(Point(9.5, -20, 30)) == 2);
  nifti.set_rows({{{{0.4f, 0.3f, 0, 10}}, {{-0.9f, 1.2f, 0, -20}}, {{0, 0, 2, 30}}}});
  const File turned("f.nii", nifti.with<std::uint8_t>(voxels()));
  check_voxels(weft::IO::read_label_image(turned.name), {{0, 0, 0}});
}

TEST_CASE("NIfTI images that hold no labels are refused")
{
  const auto error = [](const std::string& bytes) {
    const File file("g.nii", bytes);
    return error_of(file.name);
  };
  CHECK(contains(error("nothing of the kind"), "isn't a NIfTI image"));
  CHECK(contains(error(Nifti(16, 32).with<float>(voxels(), 0.5)), "aren't integers"));
  CHECK(contains(error(Nifti(16, 32).with<float>(voxels(), std::nan(""))), "aren't integers"));
  CHECK(contains(error(Nifti(2, 8).with<std::uint8_t>(std::vector<int>(24, 0))), "no voxel with a label"));
  CHECK(contains(error(Nifti(2, 8).with<std::uint8_t>(std::vector<int>(5, 1))), "ends before all voxels"));
  Nifti vectors(2, 8);
  vectors.put<std::int16_t>(40, 4);
  vectors.put<std::int16_t>(48, 2);
  CHECK(contains(error(vectors.with<std::uint8_t>(std::vector<int>(48, 1))), "several values per voxel"));
  CHECK(contains(error(Nifti(32, 64).with<double>(voxels())), "not single numbers")); // complex
}

#else

TEST_CASE("NIfTI images are refused by programs that can't read them")
{
  const File file("h.nii", "anything");
  CHECK(contains(error_of(file.name), "built without the library niftiio"));
}

#endif
