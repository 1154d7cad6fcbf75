// SPDX-License-Identifier: Apache-2.0
// Laws of include/patchproof/io/read.h, on good files. Bad files: read_errors_test.cpp.
#include "patchproof/io/read.h"

#include <clocale>
#include <filesystem>
#include <fstream>
#include <locale>

#include <gtest/gtest.h>

#include "io/io_support.h"
#include "patchproof/io/curve_mesh_file.h"

namespace patchproof {
namespace {

using test::exact;
using test::rational_model;
using test::read_good;

// One bilinear patch in each text that can hold decimals.
std::string with_coordinate(const std::string& format, const std::string& x) {
  if (format == "bpt") return "1\n1 1\n0 0 0\n0 1 0\n1 0 0\n" + x + " 1 0\n";
  if (format == "g2") return "200 1 0 0\n3 0\n2 2\n0 0 1 1\n2 2\n0 0 1 1\n0 0 0\n1 0 0\n0 1 0\n" + x + " 1 0\n";
  if (format == "gismo") return test::gismo_patch("0 0 0 1 0 0 0 1 0 " + x + " 1 0");
  return test::json_patch("[[[0,0,0],[0,1,0]],[[1,0,0],[" + x + ",1,0]]]");
}

TEST(Read, Law1_DecimalsAreExactOrNearestDoubles) {
  for (const std::string format : {"bpt", "g2", "gismo", "patchproof-model"}) {
    SCOPED_TRACE(format);
    const std::string bytes = with_coordinate(format, "1.3375");
    const auto file = read_good(bytes, "model");
    EXPECT_EQ(file.format, format);
    EXPECT_EQ(rational_model(file).patches[0].surface.point(1, 1)[0], exact("1.3375"));
    const auto rounded = read_good(bytes, "model", Decimals::binary64);
    EXPECT_EQ(rounded.decimals, Decimals::binary64);
    const Rational x = rational_model(rounded).patches[0].surface.point(1, 1)[0];
    EXPECT_EQ(x, from_double(1.3375));
    EXPECT_NE(x, exact("1.3375"));
  }
}

TEST(Read, Law1_EverySpellingOfANumber) {
  const auto x = [](const std::string& text) {
    return rational_model(read_good(with_coordinate("json", text), "m.json")).patches[0].surface.point(1, 1)[0];
  };
  EXPECT_EQ(x("-0.1e1"), Rational(-1));
  EXPECT_EQ(x("\"1/3\""), exact("1/3"));
  EXPECT_EQ(x("\"1\\/3\""), exact("1/3"));  // as PHP writes it
  EXPECT_EQ(x("\"0x1.8p-1\""), exact("3/4"));
  EXPECT_EQ(x("123456789012345678901234567890"), exact("123456789012345678901234567890"));
  EXPECT_EQ(x("-9223372036854775808"), exact("-9223372036854775808"));
  EXPECT_EQ(x("1e-320"), exact("1e-320"));
  EXPECT_EQ(x("0.1000000000000000055511151231257827021181583404541015625"),
            exact("0.1000000000000000055511151231257827021181583404541015625"));
}

TEST(Read, Law1_WhateverTheLocale) {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  const char* set = nullptr;
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "ru_RU.UTF-8"})
    if (set == nullptr) set = std::setlocale(LC_ALL, name);
  const auto file = read_model_text(with_coordinate("json", "1234.5"), "m.json");
  const auto text = read_model_text(with_coordinate("bpt", "1234.5"), "m.bpt");
  std::setlocale(LC_ALL, "C");
  std::locale::global(before);
  ASSERT_TRUE(file && text);
  EXPECT_EQ(rational_model(*file).patches[0].surface.point(1, 1)[0], exact("1234.5"));
  EXPECT_EQ(rational_model(*text).patches[0].surface.point(1, 1)[0], exact("1234.5"));
  if (set == nullptr) GTEST_SKIP() << "checked with a C++ locale only: no C locale with a decimal comma is installed";
}

TEST(Read, Law2_LineEndsAndMissingNewlineMakeNoDifference) {
  for (const auto& entry : test::good_files()) {
    SCOPED_TRACE(entry.string());
    const std::string bytes = test::bytes_of(entry);
    const auto plain = read_good(bytes, entry.string());
    std::string crlf, trimmed = bytes;
    for (const char c : bytes) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
    while (trimmed.back() == '\n') trimmed.pop_back();
    for (const std::string& other : {crlf, trimmed, "\xef\xbb\xbf" + bytes}) {
      const auto same = read_good(other, entry.string());
      EXPECT_EQ(same.format, plain.format);
      EXPECT_TRUE(test::same_model(same.model, plain.model));
      EXPECT_NE(same.sha256, plain.sha256);
    }
  }
}

// The end of every good file is cut off, byte by byte: an error, or the complete set of patches (when only blanks or the
// last digits of the last number are gone), never a part.
TEST(Read, Law2_TruncationNeverGivesAPart) {
  for (const auto& entry : test::good_files()) {
    SCOPED_TRACE(entry.string());
    const std::string bytes = test::bytes_of(entry);
    const std::size_t all = test::spline_count(read_good(bytes, entry.string()).model);
    const std::string extension = entry.extension().string();
    const std::size_t complete = bytes.find_last_not_of(" \t\r\n") + 1;
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      const auto cut = read_model_text(std::string_view(bytes).substr(0, size), entry.string());
      if (!cut) {
        EXPECT_FALSE(cut.error().message.empty());
        EXPECT_EQ(cut.error().where.rfind(entry.string(), 0), 0u) << cut.error().text();
        continue;
      }
      // .g2 and OBJ announce no number of objects, so a cut between two objects cannot be noticed.
      EXPECT_TRUE(extension == ".g2" || extension == ".obj" || test::spline_count(cut->model) == all)
          << "cut at " << size;
      EXPECT_TRUE((extension != ".json" && extension != ".xml") || size >= complete) << "cut at " << size;
    }
  }
}

TEST(Read, Law3_DenominatorsWithoutZeroAreLegal) {
  // w = 1 − u·(1 − u) with a negative middle weight; and weights all negative.
  const std::string net = "[[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]],[[2,0,0],[2,1,0]]]";
  for (const std::string weights : {"[[1,1],[-0.5,-0.5],[1,1]]", "[[-1,-2],[-1,-1],[-3,-1]]", "[[1,1],[0,0],[1,1]]"}) {
    const auto file = read_good(test::json_patch(net, ",\"weights\":" + weights, "[2,1]"), "m.json");
    EXPECT_TRUE(rational_model(file).patches[0].is_rational);
  }
}

TEST(Read, Law4_JustBelowTheLimitOfSize) {
  std::string power = to_text(Integer(boost::multiprecision::pow(Integer(2), 1000) - 1));
  const auto file = read_good(with_coordinate("bpt", power), "m.bpt");
  EXPECT_EQ(rational_model(file).patches[0].surface.point(1, 1)[0], exact(power));
}

TEST(Read, RootsChooseQuadratic) {
  const auto file = read_good(with_coordinate("bpt", "1/2+1/2*sqrt(2)"), "m.bpt");
  const auto& model = std::get<Model<Quadratic>>(file.model);
  EXPECT_EQ(model.patches[0].surface.point(1, 1)[0], Quadratic(exact("1/2"), exact("1/2"), 2));
}

TEST(Read, FormatIsRecognisedFromTheContent) {
  for (const auto& entry : test::good_files()) {
    const std::string folder = entry.parent_path().filename().string();
    const std::string expected = folder == "model" ? "patchproof-model" : folder;
    EXPECT_EQ(read_good(test::bytes_of(entry), "no_extension").format, expected) << entry;
    EXPECT_EQ(read_good(test::bytes_of(entry), entry.string()).format, expected) << entry;
  }
}

// Every example of docs/formats.md is read, as the format under whose heading it stands.
TEST(Read, TheExamplesOfTheDocumentation) {
  const std::string text = test::bytes_of(std::filesystem::path(PATCHPROOF_SOURCE_DIR) / "docs/formats.md");
  std::vector<std::string> formats;
  for (std::size_t begin = text.find("```"); begin != std::string::npos; begin = text.find("```", begin + 3)) {
    const std::size_t first = text.find('\n', begin) + 1, last = text.find("```", first);
    ASSERT_NE(last, std::string::npos);
    const std::string example = text.substr(first, last - first);
    if (looks_like_curve_mesh(example)) {
      const Result<CurveMeshFile> mesh = read_curve_mesh_text(example, "formats.md");
      ASSERT_TRUE(mesh) << mesh.error().text();
      EXPECT_TRUE(analyse(mesh->mesh)) << analyse(mesh->mesh).error().text();
      formats.push_back("patchproof-curve-mesh");
    } else {
      formats.push_back(read_good(example, "formats.md").format);
    }
    begin = last;
  }
  EXPECT_EQ(formats,
            (std::vector<std::string>{"patchproof-model", "patchproof-model", "patchproof-model", "patchproof-model",
                                      "patchproof-model", "patchproof-model", "patchproof-curve-mesh", "newell", "bpt",
                                      "bez", "g2", "gismo", "geomdl", "tinyspline", "obj"}));
}

struct Expected {
  const char* path;
  std::size_t patches, rational;
  std::vector<std::array<int, 3>> degrees;  // p, q, how often
};

// Files made by others; the counts are those of the data's own description.
TEST(Read, FilesMadeByOthers) {
  const std::filesystem::path data = std::filesystem::path(PATCHPROOF_SOURCE_DIR) / "../shared/data";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "the collection of real models is not there";
  const Expected table[] = {
      {"newell/teapot", 32, 0, {{3, 3, 32}}},
      {"newell/teacup", 26, 0, {{3, 3, 26}}},
      {"bpt/teapot.bpt", 32, 0, {{3, 3, 32}}},
      {"g2_gotools/spline_sfs1.g2", 8, 0, {{3, 3, 8}}},
      {"g2_gotools/sfs.g2", 6, 0, {{3, 3, 6}}},
      {"g2_gotools/octant.g2", 1, 1, {{2, 2, 1}}},
      {"g2_gotools/spline_cylinder.g2", 1, 1, {{2, 1, 1}}},
      {"g2_gotools/cone_sf.g2", 1, 1, {{4, 1, 1}}},
      {"g2_gotools/degenerate_sf.g2", 1, 0, {{3, 3, 1}}},
      {"g2_gotools/split_disc3.g2", 5, 0, {{3, 3, 5}}},
      {"g2_gotools/nut_top.g2", 54, 0, {{3, 3, 54}}},
      {"g2_gotools/swept_vol_sfs.g2", 30, 0, {{3, 1, 20}, {3, 3, 10}}},
      {"g2_gotools_hist/fsg_1.g2", 8, 0, {{3, 3, 8}}},
      {"g2_gotools_hist/yta4.g2", 6, 0, {{3, 3, 6}}},
      {"g2_gotools_hist/fanta_ro2_sub.g2", 5, 0, {{3, 3, 5}}},
      {"g2_splipy/torus.g2", 1, 1, {{2, 2, 1}}},
      {"g2_splipy/sphere.g2", 1, 1, {{2, 2, 1}}},
      {"gismo/teapot.xml", 32, 0, {{3, 3, 32}}},
      {"gismo/yeti_mp2.xml", 21, 0, {{2, 2, 21}}},
      {"gismo/duck_BRep.xml", 6, 0, {{2, 2, 6}}},
      {"gismo/egg.xml", 1, 1, {{2, 3, 1}}},
      {"gismo/cylinder.xml", 1, 1, {{2, 1, 1}}},
      {"gismo/square_with_disk.xml", 5, 5, {{2, 2, 5}}},
      {"gismo_unstructured/6p_hyperboloid.xml", 6, 0, {{2, 2, 6}}},
      {"gismo_unstructured/5p_spherical_cap.xml", 5, 0, {{3, 3, 5}}},
      {"gismo_unstructured/6p_shallow_paraboloid.xml", 6, 0, {{3, 3, 6}}},
      {"gismo_unstructured/4p_paraboloid_hole.xml", 4, 0, {{4, 2, 4}}},
      {"gismo_unstructured/5p_tunnel.xml", 5, 0, {{3, 3, 5}}},
      {"gismo_unstructured/3p_square_onethird.xml", 3, 0, {{1, 1, 3}}},
      {"gismo_unstructured/5p_circle.xml", 5, 4, {{2, 2, 5}}},
      {"gismo_unstructured/5p_tunnel_deformed.xml", 5, 0, {{3, 3, 5}}},
      {"geomdl_json/geomdl_surface01.json", 1, 0, {{3, 3, 1}}},
      {"geomdl_json/geomdl_surface01_decomposed.json", 9, 0, {{3, 3, 9}}},
      {"geomdl_json/geomdl_cylinder.json", 1, 1, {{1, 2, 1}}},
  };
  for (const Expected& expected : table) {
    SCOPED_TRACE(expected.path);
    const auto file = read_model((data / expected.path).string());
    ASSERT_TRUE(file) << file.error().text();
    const Model<Rational>& model = rational_model(*file);
    EXPECT_EQ(model.patches.size(), expected.patches);
    std::size_t rational = 0;
    for (const auto& patch : model.patches) rational += patch.is_rational;
    EXPECT_EQ(rational, expected.rational);
    for (const auto& [p, q, count] : expected.degrees)
      EXPECT_EQ(std::count_if(model.patches.begin(), model.patches.end(),
                              [p = p, q = q](const auto& patch) {
                                return patch.surface.degree(Direction::u) == p &&
                                       patch.surface.degree(Direction::v) == q;
                              }),
                count);
  }
  for (const char* trimmed : {"boxorthholes", "trimmed_sfs", "trimmed_sphere_no_deg_seg"}) {
    const auto file = read_model((data / "g2_gotools" / (std::string(trimmed) + ".g2")).string());
    ASSERT_FALSE(file) << trimmed;
    EXPECT_EQ(file.error().code, ErrorCode::unsupported) << file.error().text();
  }
}

// Three programs' files of one teapot are the same teapot.
TEST(Read, TheTeapotInThreeFormats) {
  const std::filesystem::path data = std::filesystem::path(PATCHPROOF_SOURCE_DIR) / "../shared/data";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "the collection of real models is not there";
  const auto newell = read_model((data / "newell/teapot").string());
  const auto bpt = read_model((data / "bpt/teapot.bpt").string());
  ASSERT_TRUE(newell && bpt);
  for (int p = 0; p < 32; ++p)
    EXPECT_EQ(rational_model(*newell).patches[p].surface.net(), rational_model(*bpt).patches[p].surface.net()) << p;
}

}  // namespace
}  // namespace patchproof
