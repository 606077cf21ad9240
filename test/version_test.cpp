// SPDX-License-Identifier: GPL-3.0-or-later

#include <catch2/catch.hpp>

#include <weft/version.h>

#include <string>

TEST_CASE("the version string is made of the numeric parts")
{
  const std::string expected = std::to_string(WEFT_VERSION_MAJOR) + "." + std::to_string(WEFT_VERSION_MINOR) + "." +
                               std::to_string(WEFT_VERSION_PATCH);
  CHECK(WEFT_VERSION == expected);
}

TEST_CASE("the version number orders versions")
{
  CHECK(WEFT_VERSION_NR / 10000 == WEFT_VERSION_MAJOR);
  CHECK(WEFT_VERSION_NR / 100 % 100 == WEFT_VERSION_MINOR);
  CHECK(WEFT_VERSION_NR % 100 == WEFT_VERSION_PATCH);
}

TEST_CASE("the package has the version of the header")
{
  CHECK(std::string(WEFT_VERSION) == WEFT_VERSION_OF_CMAKE);
}
