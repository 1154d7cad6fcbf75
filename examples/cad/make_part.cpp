// SPDX-License-Identifier: Apache-2.0
// make_part FILE.step: the part of this folder, made with Open CASCADE: a drafted block with constant and variable fillets,
// a pocket that leaves a shell, and a lofted boss.
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepOffsetAPI_DraftAngle.hxx>
#include <BRepOffsetAPI_MakeThickSolid.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Tool.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>

#include <cmath>
#include <cstdio>

namespace {

// The points at the ends of an edge.
gp_Pnt end_of(const TopoDS_Edge& edge, bool last) {
  return BRep_Tool::Pnt(last ? TopExp::LastVertex(edge) : TopExp::FirstVertex(edge));
}

// One side of the block leans by 5°.
TopoDS_Shape drafted(const TopoDS_Shape& block) {
  BRepOffsetAPI_DraftAngle draft(block);
  for (TopExp_Explorer f(block, TopAbs_FACE); f.More(); f.Next()) {
    double least = 1e9;
    for (TopExp_Explorer e(f.Current(), TopAbs_EDGE); e.More(); e.Next())
      least = std::min(least, end_of(TopoDS::Edge(e.Current()), false).X());
    if (least > 79)
      draft.Add(TopoDS::Face(f.Current()), gp_Dir(0, 0, 1), 5 * M_PI / 180, gp_Pln(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)));
  }
  draft.Build();
  return draft.Shape();
}

// Upright edges are rounded: three with radius 6, one with a radius that grows from 3 to 7.
TopoDS_Shape rounded(const TopoDS_Shape& block) {
  BRepFilletAPI_MakeFillet fillet(block);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(block, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(i));
    const gp_Pnt a = end_of(edge, false), b = end_of(edge, true);
    if (std::fabs(a.Z() - b.Z()) < 1) continue;
    if (a.X() < 1 || a.Y() < 1)
      fillet.Add(6, edge);
    else
      fillet.Add(3, 7, edge);
  }
  return fillet.Shape();
}

// Hollowed out from below; the walls are 2 thick.
TopoDS_Shape shell(const TopoDS_Shape& block) {
  TopTools_ListOfShape open;
  for (TopExp_Explorer f(block, TopAbs_FACE); f.More(); f.Next()) {
    double highest = -1e9;
    for (TopExp_Explorer e(f.Current(), TopAbs_EDGE); e.More(); e.Next())
      highest = std::max(highest, end_of(TopoDS::Edge(e.Current()), false).Z());
    if (highest < 0.5) open.Append(f.Current());
  }
  BRepOffsetAPI_MakeThickSolid thick;
  thick.MakeThickSolidByJoin(block, open, -2, 1e-6);
  return thick.Shape();
}

// Through three circles of different sizes.
TopoDS_Shape boss() {
  BRepOffsetAPI_ThruSections loft(true, false);
  for (const auto& [height, radius] : {std::pair(18.0, 12.0), {28.0, 8.0}, {38.0, 9.0}}) {
    const gp_Circ circle(gp_Ax2(gp_Pnt(40, 25, height), gp_Dir(0, 0, 1)), radius);
    loft.AddWire(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle).Edge()).Wire());
  }
  loft.Build();
  return loft.Shape();
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    std::fputs("usage: make_part FILE.step\n", stderr);
    return 2;
  }
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  try {
    const TopoDS_Shape body = rounded(drafted(BRepPrimAPI_MakeBox(80, 50, 20).Shape()));
    const TopoDS_Shape part = BRepAlgoAPI_Fuse(shell(body), boss()).Shape();
    STEPControl_Writer writer;
    if (writer.Transfer(part, STEPControl_AsIs) != IFSelect_RetDone || writer.Write(words[1]) != IFSelect_RetDone) {
      std::fprintf(stderr, "make_part: %s cannot be written\n", words[1]);
      return 1;
    }
  } catch (const Standard_Failure& failure) {
    std::fprintf(stderr, "make_part: %s\n", failure.GetMessageString());
    return 1;
  }
}
