// SPDX-License-Identifier: Apache-2.0
// Parts made with Open CASCADE, written to files of a temporary folder.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "patchproof/io/cad.h"

namespace patchproof::test {

class CadFiles : public ::testing::Test {
 protected:
  CadFiles() : folder_(std::filesystem::temp_directory_path() / ("cad_test_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
    Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  }
  ~CadFiles() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::string write_text(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }
  static std::string text_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  }

  std::string write_brep(const TopoDS_Shape& shape) const {
    BRepTools::Write(shape, path("part.brep").c_str());
    return path("part.brep");
  }
  std::string write_step(const TopoDS_Shape& shape, const char* unit = "MM") const {
    STEPControl_Controller::Init();
    Interface_Static::SetCVal("write.step.unit", unit);
    STEPControl_Writer writer;
    EXPECT_EQ(writer.Transfer(shape, STEPControl_AsIs), IFSelect_RetDone);
    EXPECT_EQ(writer.Write(path("part.step").c_str()), IFSelect_RetDone);
    return path("part.step");
  }
  std::string write_iges(const TopoDS_Shape& shape, const char* unit = "MM") const {
    IGESControl_Writer writer(unit, 1);  // 1: as boundary representation
    EXPECT_TRUE(writer.AddShape(shape));
    writer.ComputeModel();
    EXPECT_TRUE(writer.Write(path("part.igs").c_str()));
    return path("part.igs");
  }

  // Throws with the error's text.
  static CadModel read(const std::string& file, UnusableFaces unusable = UnusableFaces::refuse) {
    Result<CadModel> model = read_cad_model(file, unusable);
    if (!model) throw std::runtime_error(model.error().text());
    return std::move(*model);
  }
  static int count(const CadModel& model, CadEdgeKind kind) {
    int n = 0;
    for (const CadEdge& edge : model.edges) n += edge.kind == kind;
    return n;
  }

 private:
  const std::filesystem::path folder_;
};

inline TopoDS_Shape box() { return BRepPrimAPI_MakeBox(10, 20, 30).Shape(); }

// A block with every edge rounded: planes, cylinders and, in the corners, spheres.
inline TopoDS_Shape rounded_block() {
  const TopoDS_Shape block = box();
  BRepFilletAPI_MakeFillet fillet(block);
  for (TopExp_Explorer e(block, TopAbs_EDGE); e.More(); e.Next()) fillet.Add(2, TopoDS::Edge(e.Current()));
  return fillet.Shape();
}

inline TopoDS_Shape moved(const TopoDS_Shape& shape, const gp_Trsf& by) { return shape.Located(TopLoc_Location(by)); }

inline TopoDS_Compound compound(const std::vector<TopoDS_Shape>& parts) {
  BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& part : parts) builder.Add(all, part);
  return all;
}

}  // namespace patchproof::test
