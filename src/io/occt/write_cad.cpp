// SPDX-License-Identifier: Apache-2.0
// Models as STEP, IGES and BREP through Open CASCADE: a face for each patch, an edge for each curve.
#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_IGESWriter.hxx>
#include <IGESData_Protocol.hxx>
#include <IGESSelect_WorkLibrary.hxx>
#include <Interface_Static.hxx>
#include <Precision.hxx>
#include <STEPConstruct.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <StepRepr_NextAssemblyUsageOccurrence.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <Transfer_FinderProcess.hxx>
#include <XSControl_TransferWriter.hxx>
#include <XSControl_WorkSession.hxx>

#include <algorithm>
#include <sstream>

#include "../write_doubles.h"
#include "patchproof/io/profile.h"
#include "patchproof/io/write.h"
#include "patchproof/patch/patch_knots.h"
#include "patchproof/scalar/parse_scalar.h"
#include "patchproof/spline/bezier_extraction.h"
#include "silence.h"

namespace patchproof {
namespace {

struct Part {
  TopoDS_Shape shape;
  std::string name;
};

Error refused(const std::string& where, const std::string& message, const std::string& values = "") {
  return {ErrorCode::unsupported, where, "Open CASCADE has no such spline: " + message, values};
}

// What Open CASCADE writes and reads again without harm: printable ASCII without apostrophes (its reader of STEP ends a
// string at '') too early); '?' for each other character.
std::string plain(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xc0) == 0x80) continue;  // a character's first byte has stood for it
    out += 0x20 <= byte && byte < 0x7f && c != '\'' ? c : '?';
  }
  return out;
}

// Open CASCADE counts what a process writes, "patchproof 3.1"; here everything is the first.
constexpr const char* kProduct = "patchproof";
opencascade::handle<TCollection_HAsciiString> as_the_first(const opencascade::handle<TCollection_HAsciiString>& name) {
  const std::string text = name.IsNull() ? "" : name->ToCString(), counted = std::string(kProduct) + " ";
  if (text.rfind(counted, 0) != 0) return name;
  const std::size_t end = text.find_first_not_of("0123456789", counted.size());
  const std::string rest = end == std::string::npos ? "" : text.substr(end);
  return new TCollection_HAsciiString((counted + "1" + rest).c_str());
}
void count_from_one(const opencascade::handle<StepData_StepModel>& model) {
  int uses = 0;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto entity = model->Entity(i);
    if (const auto product = opencascade::handle<StepBasic_Product>::DownCast(entity); !product.IsNull()) {
      product->SetId(as_the_first(product->Id()));
      product->SetName(as_the_first(product->Name()));
    }
    if (const auto use = opencascade::handle<StepRepr_NextAssemblyUsageOccurrence>::DownCast(entity); !use.IsNull())
      use->SetId(new TCollection_HAsciiString(std::to_string(++uses).c_str()));
  }
}

// Distinct knots with their multiplicities.
struct Knots {
  std::vector<double> values;
  std::vector<int> multiplicities;

  TColStd_Array1OfReal value_array() const {
    TColStd_Array1OfReal out(1, static_cast<int>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) out(static_cast<int>(i) + 1) = values[i];
    return out;
  }
  TColStd_Array1OfInteger multiplicity_array() const {
    TColStd_Array1OfInteger out(1, static_cast<int>(multiplicities.size()));
    for (std::size_t i = 0; i < multiplicities.size(); ++i) out(static_cast<int>(i) + 1) = multiplicities[i];
    return out;
  }
};

template <ExactField T>
class CadWriter {
 public:
  CadWriter(const Model<T>& model, CadFormat format) : model_(model), format_(format) {}

  Result<WrittenModel> write() {
    if (model_.curves.empty() && model_.patches.empty())
      return Error{ErrorCode::unsupported, "model", "a CAD file holds at least one curve or patch", ""};
    scale_to_millimetres();
    for (std::size_t k = 0; k < model_.patches.size(); ++k)
      if (const auto error = add_patch(model_.patches[k], fmt::format("patch {}", k))) return *error;
    for (std::size_t k = 0; k < model_.curves.size(); ++k)
      if (const auto error = add_curve(model_.curves[k], fmt::format("curve {}", k))) return *error;
    WrittenModel out{"", std::move(notes_)};
    if (model_.patches.size() > 1)
      out.notes.push_back("each patch is a face by itself: edges that meet are not shared");
    const bool has_names = format_ == CadFormat::step;
    for (std::string& note : left_out(model_, has_names, true)) out.notes.push_back(std::move(note));
    const auto is_changed = [](const Part& part) { return plain(part.name) != part.name; };
    if (has_names && std::any_of(parts_.begin(), parts_.end(), is_changed))
      out.notes.push_back("names: '?' stands for apostrophes and for characters beyond printable ASCII");
    if (rounding_.inexact() > 0)
      out.notes.push_back(
          fmt::format("{} of {} numbers are rounded to the nearest double", rounding_.inexact(), rounding_.numbers()));
    std::ostringstream bytes;
    const bool written = format_ == CadFormat::step   ? write_step(bytes)
                         : format_ == CadFormat::iges ? write_iges(bytes)
                                                      : write_brep(bytes);
    if (!written) return Error{ErrorCode::unsupported, "model", "Open CASCADE cannot write it", ""};
    out.bytes = std::move(bytes).str();
    return out;
  }

 private:
  void scale_to_millimetres() {
    if (format_ == CadFormat::brep) {
      if (!model_.units.empty()) notes_.push_back("units " + model_.units + " left out: the format has none");
      return;
    }
    const std::optional<double> scale = millimetres_per(model_.units);
    if (!scale)
      notes_.push_back("the unit " + model_.units + " is not known: lengths are written as millimetres");
    else if (model_.units.empty())
      notes_.push_back("the model names no units: lengths are written as millimetres");
    else if (*scale != 1)
      notes_.push_back(fmt::format("lengths are written in millimetres, {} for 1 {}", *scale, model_.units));
    // The unit's decimal, 25.4, and not the double next to it.
    if (scale) scale_ = T(parse_scalar<Rational>(fmt::format("{}", *scale)).value());
  }

  std::optional<Error> knots(const KnotVector<T>& knots, const std::string& where, Knots& out) {
    if (knots.degree() > Geom_BSplineSurface::MaxDegree() || knots.degree() < 1)
      return refused(where, fmt::format("degrees are from 1 to {}", Geom_BSplineSurface::MaxDegree()),
                     std::to_string(knots.degree()));
    rounding_.keep_apart(knots);
    for (const T& t : knots.knots()) {
      const double value = rounding_(t);
      if (out.values.empty() || out.values.back() != value) {
        out.values.push_back(value);
        out.multiplicities.push_back(0);
      }
      ++out.multiplicities.back();
    }
    for (std::size_t i = 0; i < out.values.size(); ++i)
      if (const bool end = i == 0 || i + 1 == out.values.size(); out.multiplicities[i] > knots.degree() + end)
        return refused(where, end ? "a knot stands more than degree + 1 times" : "it may jump at a knot inside",
                       fmt::format("{}", out.values[i]));
    return std::nullopt;
  }

  std::optional<Error> pole(const Vec<T, 4>& p, const std::string& where, gp_Pnt& point, double& weight) {
    if (!(T(0) < p[3])) return refused(where, "weights are positive", to_text(p[3]));
    weight = rounding_(p[3]);
    const auto coordinate = [&](int c) { return rounding_(p[c] / p[3] * scale_); };
    const double x = coordinate(0), y = coordinate(1), z = coordinate(2);
    point = gp_Pnt(x, y, z);
    return rounding_.error(where);
  }

  std::optional<Error> add_patch(const ModelPatch<T>& patch, const std::string& where) {
    const BsplinePatch<T, 4> surface = clamp(clamp(patch.surface, Direction::u), Direction::v);
    Knots u, v;
    if (auto error = knots(surface.knots(Direction::u), where, u)) return error;
    if (auto error = knots(surface.knots(Direction::v), where, v)) return error;
    const int rows = surface.count(Direction::u), columns = surface.count(Direction::v);
    TColgp_Array2OfPnt poles(1, rows, 1, columns);
    TColStd_Array2OfReal weights(1, rows, 1, columns);
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j)
        if (auto error = pole(surface.point(i, j), where, poles(i + 1, j + 1), weights(i + 1, j + 1))) return error;
    try {
      const int p = surface.degree(Direction::u), q = surface.degree(Direction::v);
      const opencascade::handle<Geom_BSplineSurface> made =
          patch.is_rational ? new Geom_BSplineSurface(poles, weights, u.value_array(), v.value_array(),
                                                      u.multiplicity_array(), v.multiplicity_array(), p, q)
                            : new Geom_BSplineSurface(poles, u.value_array(), v.value_array(), u.multiplicity_array(),
                                                      v.multiplicity_array(), p, q);
      BRepBuilderAPI_MakeFace face(made, Precision::Confusion());
      if (!face.IsDone()) return refused(where, "it makes no face of it");
      parts_.push_back({face.Face(), patch.name});
    } catch (const Standard_Failure& failure) {
      return refused(where, failure.GetMessageString());
    }
    return std::nullopt;
  }

  std::optional<Error> add_curve(const ModelCurve<T>& model_curve, const std::string& where) {
    const BsplineCurve<T, 4> curve = clamp(model_curve.curve);
    Knots t;
    if (auto error = knots(curve.knots(), where, t)) return error;
    const int count = static_cast<int>(curve.points().size());
    TColgp_Array1OfPnt poles(1, count);
    TColStd_Array1OfReal weights(1, count);
    for (int i = 0; i < count; ++i)
      if (auto error = pole(curve.points()[i], where, poles(i + 1), weights(i + 1))) return error;
    try {
      const int degree = curve.knots().degree();
      const opencascade::handle<Geom_BSplineCurve> made =
          model_curve.is_rational
              ? new Geom_BSplineCurve(poles, weights, t.value_array(), t.multiplicity_array(), degree)
              : new Geom_BSplineCurve(poles, t.value_array(), t.multiplicity_array(), degree);
      BRepBuilderAPI_MakeEdge edge(made);
      if (!edge.IsDone()) return refused(where, "it makes no edge of it");
      parts_.push_back({edge.Edge(), model_curve.name});
    } catch (const Standard_Failure& failure) {
      return refused(where, failure.GetMessageString());
    }
    return std::nullopt;
  }

  TopoDS_Compound compound() const {
    TopoDS_Compound out;
    BRep_Builder builder;
    builder.MakeCompound(out);
    for (const Part& part : parts_) builder.Add(out, part.shape);
    return out;
  }

  bool write_brep(std::ostream& out) const {
    BRepTools::Write(compound(), out, false, false, TopTools_FormatVersion_CURRENT);
    return out.good();
  }

  bool write_step(std::ostream& out) const {
    STEPControl_Controller::Init();
    Interface_Static::SetCVal("write.step.unit", "MM");
    Interface_Static::SetCVal("write.step.product.name", kProduct);
    STEPControl_Writer writer;
    if (writer.Transfer(compound(), STEPControl_AsIs) != IFSelect_RetDone) return false;
    const auto model = opencascade::handle<StepData_StepModel>::DownCast(writer.WS()->Model());
    for (const Part& part : parts_) {
      if (part.name.empty()) continue;
      const auto item = STEPConstruct::FindEntity(writer.WS()->TransferWriter()->FinderProcess(), part.shape);
      if (!item.IsNull()) item->SetName(new TCollection_HAsciiString(plain(part.name).c_str()));
    }
    count_from_one(model);
    APIHeaderSection_MakeHeader header(model);
    header.SetName(new TCollection_HAsciiString("patchproof"));
    header.SetTimeStamp(new TCollection_HAsciiString("1970-01-01T00:00:00"));  // the same model, the same bytes
    StepData_StepWriter text(model);
    text.FloatWriter().SetFormat("%.16E", true);  // 17 digits: the default has fewer
    text.SendModel(opencascade::handle<StepData_Protocol>::DownCast(writer.WS()->Protocol()));
    return text.Print(out);
  }

  bool write_iges(std::ostream& out) const {
    IGESControl_Controller::Init();
    IGESControl_Writer writer("MM", 0);
    for (const Part& part : parts_)
      if (!writer.AddShape(part.shape)) return false;
    writer.ComputeModel();
    IGESData_IGESWriter text(writer.Model());
    text.FloatWriter().SetFormat("%.16E", true);
    text.SendModel(IGESSelect_WorkLibrary::DefineProtocol());
    return text.Print(out);
  }

  const Model<T>& model_;
  CadFormat format_;
  T scale_{1};
  Rounding rounding_;
  std::vector<Part> parts_;
  std::vector<std::string> notes_;
};

}  // namespace

template <ExactField T>
Result<WrittenModel> write_model_cad(const Model<T>& model, CadFormat format) {
  const occt::Silence silence;
  try {
    if (model.gregory_patches.empty()) return CadWriter<T>(model, format).write();
    Result<SplinesOnly<T>> splines = with_splines_only(model);
    if (!splines) return splines.error();
    Result<WrittenModel> out = CadWriter<T>(splines->model, format).write();
    if (out) out->notes.insert(out->notes.begin(), splines->notes.begin(), splines->notes.end());
    return out;
  } catch (const Standard_Failure& failure) {
    return Error{ErrorCode::unsupported, "model", std::string("Open CASCADE: ") + failure.GetMessageString(), ""};
  }
}

template Result<WrittenModel> write_model_cad(const Model<Rational>&, CadFormat);
template Result<WrittenModel> write_model_cad(const Model<Quadratic>&, CadFormat);

}  // namespace patchproof
