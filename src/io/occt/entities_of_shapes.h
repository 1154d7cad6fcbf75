// SPDX-License-Identifier: Apache-2.0
// Which entity of a STEP or IGES file each shape came from. Open CASCADE walks through all results for every question;
// here they are walked through once.
#pragma once

#include <Interface_InterfaceModel.hxx>
#include <NCollection_DataMap.hxx>
#include <Standard_Transient.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS_Shape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_Reader.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>

namespace patchproof::occt {

class EntitiesOfShapes {
 public:
  explicit EntitiesOfShapes(const XSControl_Reader& reader) {
    const auto& process = reader.WS()->TransferReader()->TransientProcess();
    for (int i = 1; !process.IsNull() && i <= process->NbMapped(); ++i) {
      const auto entity = process->Mapped(i);
      const TopoDS_Shape shape = TransferBRep::ShapeResult(process, entity);
      if (!shape.IsNull() && !first_.IsBound(shape)) first_.Bind(shape, entity);
    }
    model_ = reader.WS()->Model();
  }

  // The first entity that this shape came from, in either orientation, else one that it came from before it was moved to
  // its place; null when there is none.
  opencascade::handle<Standard_Transient> entity_of(const TopoDS_Shape& shape) const {
    for (const TopoDS_Shape& candidate : {shape, shape.Located(TopLoc_Location())})
      if (first_.IsBound(candidate) && model_->Contains(first_.Find(candidate))) return first_.Find(candidate);
    return nullptr;
  }

 private:
  NCollection_DataMap<TopoDS_Shape, opencascade::handle<Standard_Transient>, TopTools_ShapeMapHasher> first_;
  opencascade::handle<Interface_InterfaceModel> model_;
};

}  // namespace patchproof::occt
