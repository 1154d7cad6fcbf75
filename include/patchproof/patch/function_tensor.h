// SPDX-License-Identifier: Apache-2.0
// Tensors of functions, and the surfaces they give: bases in any coordinate, tensor products of bases, and their inner
// product with a net of control data.
//
//   (f ⊗ g)_{I,J}(x) = f_I(x) g_J(x)          ⟨f, g⟩(x) = Σ_I f_I(x) g_I(x)
//   S(u,v) = Σ_i Σ_j U_i(u) V_j(v) P_ij        each component is ⟨U ⊗ V, net⟩; the sum is taken once (E-LAR-02)
//
// Functions are maps into T^1 (transfinite.h), so a basis may be any functions, and the entries of a net may be points or
// maps of the whole parameter point.
//
// ENSURES   (1) bernstein_functions and bspline_functions are the functions of bernstein.h and bspline_basis.h in the chosen
//           coordinate;  (2) flatten keeps the functions, in row-major order;  (3) tensor_product has the shapes one after
//           the other, inner_product is symmetric and bilinear;  (4) tensor_product_surface of Bernstein or B-spline bases
//           and points is the patch of that net.
// SCALARS   T: Ring, K: OrderedField.
// ERRORS    wrong_count: shapes that differ, a net that does not fit its bases, an empty shape.
// SOURCE    A. Paoluzzi, Geometric Programming for Computer-Aided Design, ch. 11.
// TEST      tests/patch/function_tensor_test.cpp checks (1)–(4).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "patchproof/patch/transfinite.h"

namespace patchproof {

template <Ring T, std::size_t D, OrderedField K = knot_scalar_t<T>>
class FunctionTensor {
 public:
  using Function = TransfiniteMap<T, D, 1, K>;

  // The last index runs fastest. ERRORS wrong_count unless every extent is positive and their product is the number of
  // functions.
  static Result<FunctionTensor> make(std::vector<int> shape, std::vector<Function> functions);
  // One index.
  FunctionTensor(std::vector<Function> functions)
      : shape_{static_cast<int>(functions.size())}, functions_(std::move(functions)) {}

  const std::vector<int>& shape() const { return shape_; }
  const std::vector<Function>& functions() const { return functions_; }

 private:
  FunctionTensor(std::vector<int> shape, std::vector<Function> functions)
      : shape_(std::move(shape)), functions_(std::move(functions)) {}
  std::vector<int> shape_;
  std::vector<Function> functions_;
};

// The tensor of constant functions with these values.
template <Ring T, std::size_t D, OrderedField K = knot_scalar_t<T>>
Result<FunctionTensor<T, D, K>> constant_functions(std::vector<int> shape, const std::vector<T>& values) {
  using Function = TransfiniteMap<T, D, 1, K>;
  std::vector<Function> functions;
  for (const T& value : values) functions.push_back(Function(Vec<T, 1>{{value}}));
  return FunctionTensor<T, D, K>::make(std::move(shape), std::move(functions));
}

template <Ring T, std::size_t D, OrderedField K>
FunctionTensor<T, D, K> flatten(const FunctionTensor<T, D, K>& tensor) {
  return FunctionTensor<T, D, K>(tensor.functions());
}

// ERRORS wrong_count when the shapes differ. REQUIRES equal domains in the coordinates that both depend on.
template <Ring T, std::size_t D, OrderedField K>
Result<TransfiniteMap<T, D, 1, K>> inner_product(const FunctionTensor<T, D, K>& f, const FunctionTensor<T, D, K>& g);

template <Ring T, std::size_t D, OrderedField K>
FunctionTensor<T, D, K> tensor_product(const FunctionTensor<T, D, K>& f, const FunctionTensor<T, D, K>& g);

// N_0 … N_{n−1} of the knots, as functions of x_s.
template <Ring T, std::size_t D, OrderedField K>
FunctionTensor<T, D, K> bspline_functions(std::size_t s, const KnotVector<K>& knots);

// B_0^n … B_n^n as functions of x_s. REQUIRES degree ≥ 0.
template <Ring T, std::size_t D, OrderedField K = knot_scalar_t<T>>
FunctionTensor<T, D, K> bernstein_functions(std::size_t s, int degree) {
  return bspline_functions<T, D, K>(s, KnotVector<K>::bezier(degree));
}

// Σ_i Σ_j U_i V_j P_ij; net[i][j] goes with U_i V_j.
// ERRORS wrong_count unless the net has a row for each U_i and an entry for each V_j.
template <Ring T, std::size_t D, std::size_t N, OrderedField K>
Result<TransfiniteMap<T, D, N, K>> tensor_product_surface(
    const FunctionTensor<T, D, K>& u, const FunctionTensor<T, D, K>& v,
    const std::vector<std::vector<TransfiniteMap<T, D, N, K>>>& net);

// The Bézier patch of this degree in both directions: bilinear (1), biquadratic (2), bicubic (3), …
// ERRORS wrong_count unless the net has degree + 1 rows of degree + 1 entries.
template <Ring T, std::size_t N, OrderedField K = knot_scalar_t<T>>
Result<TransfiniteMap<T, 2, N, K>> bezier_surface(int degree,
                                                  const std::vector<std::vector<TransfiniteMap<T, 2, N, K>>>& net) {
  return tensor_product_surface(bernstein_functions<T, 2, K>(0, degree), bernstein_functions<T, 2, K>(1, degree), net);
}

// ---------------------------------------------------------------------------------------------------------------------

template <Ring T, std::size_t D, OrderedField K>
Result<FunctionTensor<T, D, K>> FunctionTensor<T, D, K>::make(std::vector<int> shape, std::vector<Function> functions) {
  std::size_t count = 1;
  bool positive = !shape.empty();
  for (const int extent : shape) {
    positive = positive && extent > 0;
    // A shape that asks for more than there is needs no exact product.
    count = positive && count <= functions.size() ? count * extent : count;
  }
  if (!positive || count != functions.size())
    return Error{ErrorCode::wrong_count, "", "the shape of the tensor does not fit its functions",
                 std::to_string(functions.size()) + " functions"};
  return FunctionTensor(std::move(shape), std::move(functions));
}

template <Ring T, std::size_t D, OrderedField K>
Result<TransfiniteMap<T, D, 1, K>> inner_product(const FunctionTensor<T, D, K>& f, const FunctionTensor<T, D, K>& g) {
  if (f.shape() != g.shape())
    return Error{ErrorCode::wrong_count, "", "an inner product needs two tensors of one shape",
                 std::to_string(f.functions().size()) + " and " + std::to_string(g.functions().size()) + " functions"};
  TransfiniteMap<T, D, 1, K> sum(Vec<T, 1>{{T(0)}});
  for (std::size_t i = 0; i < f.functions().size(); ++i) sum = sum + product(f.functions()[i], g.functions()[i]);
  return sum;
}

template <Ring T, std::size_t D, OrderedField K>
FunctionTensor<T, D, K> tensor_product(const FunctionTensor<T, D, K>& f, const FunctionTensor<T, D, K>& g) {
  std::vector<int> shape = f.shape();
  shape.insert(shape.end(), g.shape().begin(), g.shape().end());
  std::vector<TransfiniteMap<T, D, 1, K>> functions;
  for (const auto& a : f.functions())
    for (const auto& b : g.functions()) functions.push_back(product(a, b));
  return *FunctionTensor<T, D, K>::make(std::move(shape), std::move(functions));
}

template <Ring T, std::size_t D, OrderedField K>
FunctionTensor<T, D, K> bspline_functions(std::size_t s, const KnotVector<K>& knots) {
  using Function = TransfiniteMap<T, D, 1, K>;
  const int n = knots.control_count();
  std::vector<Function> functions;
  for (int i = 0; i < n; ++i) {
    std::vector<Function> controls(n, Function(Vec<T, 1>{{T(0)}}));
    controls[i] = Function(Vec<T, 1>{{T(1)}});
    functions.push_back(*Function::blend(s, knots, std::move(controls)));
  }
  return FunctionTensor<T, D, K>(std::move(functions));
}

template <Ring T, std::size_t D, std::size_t N, OrderedField K>
Result<TransfiniteMap<T, D, N, K>> tensor_product_surface(
    const FunctionTensor<T, D, K>& u, const FunctionTensor<T, D, K>& v,
    const std::vector<std::vector<TransfiniteMap<T, D, N, K>>>& net) {
  const std::size_t rows = u.functions().size(), columns = v.functions().size();
  bool fits = net.size() == rows && rows > 0 && columns > 0;
  for (const auto& row : net) fits = fits && row.size() == columns;
  if (!fits)
    return Error{ErrorCode::wrong_count, "",
                 "the bases need " + std::to_string(rows) + " x " + std::to_string(columns) + " control data",
                 std::to_string(net.size()) + " rows" +
                     (net.empty() ? std::string() : ", the first of " + std::to_string(net[0].size()))};
  const auto row_sum = [&](std::size_t i) {
    auto sum = product(v.functions()[0], net[i][0]);
    for (std::size_t j = 1; j < columns; ++j) sum = sum + product(v.functions()[j], net[i][j]);
    return product(u.functions()[i], sum);
  };
  TransfiniteMap<T, D, N, K> surface = row_sum(0);
  for (std::size_t i = 1; i < rows; ++i) surface = surface + row_sum(i);
  return surface;
}

}  // namespace patchproof
