// SPDX-License-Identifier: Apache-2.0
#include "load.h"

#include <IGESControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Check.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <STEPControl_Reader.hxx>
#include <StepData_StepModel.hxx>
#include <StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <StepShape_FaceSurface.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>

#include <map>
#include <optional>
#include <set>

#include "entities_of_shapes.h"
#include "step_numbers.h"

namespace patchproof::occt {
namespace {

using Entity = opencascade::handle<Standard_Transient>;
using Model = opencascade::handle<Interface_InterfaceModel>;

Error cannot_read(const std::string& path, const std::string& message) {
  return {ErrorCode::syntax, path, message, ""};
}

// "#123 'name'" in STEP files, "D57" in IGES files.
std::string entity_label(const Model& model, const Entity& entity) {
  std::string label = model->StringLabel(entity)->ToCString();
  const auto item = opencascade::handle<StepRepr_RepresentationItem>::DownCast(entity);
  if (item.IsNull() || item->Name().IsNull()) return label;
  const std::string name = item->Name()->ToCString();
  return name.empty() || name == "NONE" ? label : label + " '" + name + "'";
}

// A face that stands in several places of an assembly is as many faces: "#12", "#12 (2)".
void number_repeated(std::vector<std::string>& labels) {
  std::map<std::string, int> times;
  for (std::string& label : labels)
    if (const int n = ++times[label]; n > 1) label += " (" + std::to_string(n) + ")";
}

template <class LabelOf>
void label_all(Loaded& loaded, LabelOf label_of) {
  const auto label = [&](std::vector<std::string>& labels, const char* what, const TopoDS_Shape& shape) {
    const std::string given = label_of(shape);
    labels.push_back(given.empty() ? plain_label(what, static_cast<int>(labels.size()) + 1) : given);
  };
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(loaded.shape, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i) label(loaded.face_labels, "face", faces(i));
  TopTools_IndexedDataMapOfShapeListOfShape edges;
  TopExp::MapShapesAndAncestors(loaded.shape, TopAbs_EDGE, TopAbs_FACE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) label(loaded.edge_labels, "edge", edges.FindKey(i));
  number_repeated(loaded.face_labels);
  number_repeated(loaded.edge_labels);
}

void label_by_entity(Loaded& loaded, const XSControl_Reader& reader, const EntitiesOfShapes& entities) {
  label_all(loaded, [&](const TopoDS_Shape& shape) {
    const Entity entity = entities.entity_of(shape);
    return entity.IsNull() ? std::string() : entity_label(reader.WS()->Model(), entity);
  });
}

// What of a file cannot be read as it stands there.
class Unread {
 public:
  Unread(const XSControl_Reader& reader, BadNumbers numbers)
      : model_(reader.WS()->Model()), graph_(reader.WS()->Graph()), numbers_(std::move(numbers)) {
    for (int i = 1; i <= model_->NbEntities(); ++i) none_ = none_ && !is(i);
  }

  // An entity, among an entity and all that it refers to; null when there is none.
  Entity part_of(const Entity& root) const {
    if (none_) return nullptr;
    std::set<int> seen;
    std::vector<Entity> waiting{root};
    while (!waiting.empty()) {
      const Entity entity = waiting.back();
      waiting.pop_back();
      const int number = model_->Number(entity);
      if (!seen.insert(number).second) continue;
      if (is(number)) return entity;
      for (Interface_EntityIterator part = graph_.Shareds(entity); part.More(); part.Next())
        waiting.push_back(part.Value());
    }
    return nullptr;
  }

  // "entity #12 of it cannot be read: line 40 has NAN, no number that can be used"
  std::string text(const Entity& part) const {
    const std::string out = std::string("entity ") + model_->StringLabel(part)->ToCString() + " of it cannot be read";
    const auto bad = numbers_.find(label_of(part));
    return bad == numbers_.end() ? out : out + ": " + text(bad->second);
  }
  static std::string text(const BadNumber& bad) {
    return "line " + std::to_string(bad.line) + " has " + bad.value + ", no number that can be used";
  }

  const BadNumbers& numbers() const { return numbers_; }

 private:
  long label_of(const Entity& entity) const {
    const auto step = opencascade::handle<StepData_StepModel>::DownCast(model_);
    return step.IsNull() ? 0 : step->IdentLabel(entity);
  }
  // Open CASCADE leaves zeros where a parameter cannot be read. Texts do not matter: real files have $ for empty names.
  bool is(int number) const {
    if (number <= 0) return false;
    if (!numbers_.empty() && numbers_.count(label_of(model_->Value(number)))) return true;
    const auto check = model_->Check(number, true);
    for (int i = 1; i <= check->NbFails(); ++i)
      if (std::string_view(check->CFail(i)).find("not a quoted String") == std::string_view::npos) return true;
    return check->NbFails() == 0 && model_->IsErrorEntity(number);
  }

  const Model model_;
  const Interface_Graph& graph_;
  const BadNumbers numbers_;
  bool none_ = true;
};

bool has_weight_not_positive(const Entity& face) {
  const auto with_surface = opencascade::handle<StepShape_FaceSurface>::DownCast(face);
  if (with_surface.IsNull()) return false;
  const auto surface = opencascade::handle<StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface>::DownCast(
      with_surface->FaceGeometry());
  if (surface.IsNull() || surface->WeightsData().IsNull()) return false;
  for (int i = 1; i <= surface->NbWeightsDataI(); ++i)
    for (int j = 1; j <= surface->NbWeightsDataJ(); ++j)
      if (!(surface->WeightsDataValue(i, j) > 0)) return true;
  return false;
}

// Which faces of the file are missing in the shape, and which hold numbers that are not in the file.
template <class IsFace>
void find_faults(Loaded& loaded, const XSControl_Reader& reader, const EntitiesOfShapes& entities, const Unread& unread,
                 IsFace is_face) {
  const Model model = reader.WS()->Model();
  const auto& process = reader.WS()->TransferReader()->TransientProcess();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Entity entity = model->Value(i);
    if (!is_face(entity) || !TransferBRep::ShapeResult(process, entity).IsNull()) continue;
    const Entity part = unread.part_of(entity);
    const std::string label = entity_label(model, entity);
    if (!part.IsNull())
      loaded.missing.push_back({label, ErrorCode::syntax, unread.text(part)});
    else if (has_weight_not_positive(entity))
      loaded.missing.push_back({label, ErrorCode::unsupported,
                                "its surface has a weight that is not positive: Open CASCADE knows no such surfaces"});
    else
      loaded.missing.push_back({label, ErrorCode::unsupported, "Open CASCADE builds no face from it"});
  }
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(loaded.shape, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i) {
    const Entity entity = entities.entity_of(faces(i)), part = entity.IsNull() ? nullptr : unread.part_of(entity);
    loaded.face_faults.emplace_back();
    if (!part.IsNull()) loaded.face_faults.back() = Damage{ErrorCode::syntax, unread.text(part)};
  }
}

bool is_step_face(const Entity& entity) { return entity->IsKind(STANDARD_TYPE(StepShape_FaceSurface)); }

// Bounded and trimmed surfaces, faces of solids.
bool is_iges_face(const Entity& entity) {
  const auto iges = opencascade::handle<IGESData_IGESEntity>::DownCast(entity);
  const int type = iges.IsNull() ? 0 : iges->TypeNumber();
  return type == 143 || type == 144 || type == 510;
}

std::optional<Error> first_unread_face(const std::string& path, const XSControl_Reader& reader, const Unread& unread,
                                       bool (*is_face)(const Entity&)) {
  const Model model = reader.WS()->Model();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Entity entity = model->Value(i);
    if (!is_face(entity)) continue;
    if (const Entity part = unread.part_of(entity); !part.IsNull())
      return Error{ErrorCode::syntax, path + " at " + entity_label(model, entity),
                   "the face is not usable: " + unread.text(part), ""};
  }
  return std::nullopt;
}

// Of a STEP file: no face, but a placement or a unit perhaps.
std::optional<Error> first_bad_number(const std::string& path, const BadNumbers& numbers) {
  if (numbers.empty()) return std::nullopt;
  const auto& [entity, bad] = *numbers.begin();
  return Error{ErrorCode::syntax, path + " at #" + std::to_string(entity), Unread::text(bad), ""};
}

// Faces that cannot be read lose their surfaces, so that Open CASCADE does not try to build them from zeros.
void drop_unread_faces(const XSControl_Reader& reader, const Unread& unread) {
  const Model model = reader.WS()->Model();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto face = opencascade::handle<StepShape_FaceSurface>::DownCast(model->Value(i));
    if (!face.IsNull() && !unread.part_of(face).IsNull()) face->SetFaceGeometry(nullptr);
  }
}

Result<Loaded> load_step(const std::string& path, std::string_view bytes, UnusableFaces unusable) {
  STEPControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
    return cannot_read(path, "Open CASCADE cannot read the STEP file");
  const Unread unread(reader, bad_step_numbers(bytes));
  if (unusable == UnusableFaces::refuse) {
    if (const auto error = first_unread_face(path, reader, unread, is_step_face)) return *error;
    if (const auto error = first_bad_number(path, unread.numbers())) return *error;
  }
  drop_unread_faces(reader, unread);
  Loaded loaded;
  for (const auto& [entity, bad] : unread.numbers())  // of what is no face, too
    if (loaded.notes.size() < 10) loaded.notes.push_back("#" + std::to_string(entity) + ": " + Unread::text(bad));
  TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
  reader.FileUnits(lengths, angles, solid_angles);
  loaded.units = "mm";  // Open CASCADE converts
  if (lengths.Length() > 0 && !lengths.First().IsEqual("millimetre"))
    loaded.units += std::string(" (file: ") + lengths.First().ToCString() + ")";
  reader.TransferRoots();
  loaded.shape = reader.OneShape();
  const EntitiesOfShapes entities(reader);
  if (!loaded.shape.IsNull()) label_by_entity(loaded, reader, entities);
  find_faults(loaded, reader, entities, unread, is_step_face);
  if (loaded.shape.IsNull() && loaded.missing.empty())
    return cannot_read(path, "the STEP file holds no shape that Open CASCADE can build");
  return loaded;
}

Result<Loaded> load_iges(const std::string& path, UnusableFaces unusable) {
  IGESControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
    return cannot_read(path, "Open CASCADE cannot read the IGES file");
  Loaded loaded;
  loaded.units = "mm";
  const auto model = opencascade::handle<IGESData_IGESModel>::DownCast(reader.WS()->Model());
  if (model.IsNull()) return cannot_read(path, "Open CASCADE cannot read the IGES file");
  const Unread unread(reader, {});
  if (unusable == UnusableFaces::refuse)
    if (const auto error = first_unread_face(path, reader, unread, is_iges_face)) return *error;
  const auto unit = model->GlobalSection().UnitName();
  if (!unit.IsNull() && unit->Length() > 0 && !unit->IsSameString(new TCollection_HAsciiString("MM")))
    loaded.units += std::string(" (file: ") + unit->ToCString() + ")";
  reader.TransferRoots();
  loaded.shape = reader.OneShape();
  const EntitiesOfShapes entities(reader);
  if (!loaded.shape.IsNull()) label_by_entity(loaded, reader, entities);
  find_faults(loaded, reader, entities, unread, is_iges_face);
  if (loaded.shape.IsNull() && loaded.missing.empty())
    return cannot_read(path, "the IGES file holds no shape that Open CASCADE can build");
  return loaded;
}

}  // namespace

std::string format_of(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, 4096);
  const auto holds = [&](std::string_view text) { return head.find(text) != std::string_view::npos; };
  return holds("ISO-10303-21") ? "step" : holds("DBRep_DrawableShape") || holds("CASCADE Topology") ? "brep" : "iges";
}

std::string plain_label(const char* what, int index) { return std::string(what) + " " + std::to_string(index); }

Error about_faces(const std::string& path, const std::vector<LeftOutFace>& unusable) {
  const LeftOutFace& face = unusable.front();
  std::string more;
  if (const std::size_t others = unusable.size() - 1; others > 0)
    more = "; " + std::to_string(others) + (others == 1 ? " more face is" : " more faces are") + " not usable either";
  return {face.code, path + " at " + face.label, "the face is not usable: " + face.reason + more, ""};
}

Result<Loaded> load(const std::string& path, std::string_view bytes, const std::string& format,
                    UnusableFaces unusable) {
  if (format == "brep") return load_brep(path, bytes, unusable);
  return format == "step" ? load_step(path, bytes, unusable) : load_iges(path, unusable);
}

}  // namespace patchproof::occt
