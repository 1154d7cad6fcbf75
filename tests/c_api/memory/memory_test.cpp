// SPDX-License-Identifier: Apache-2.0
// When memory runs out. `operator new` fails once, at one place after the other (of the first 256 at each): each call then ends with PATCHPROOF_OUT_OF_MEMORY,
// leaves its outputs alone and works when it is made again. Not of reports as JSON and of .glb: the objects of the JSON library
// that writes them need memory to be destroyed.
#include <atomic>
#include <cstdlib>
#include <functional>
#include <new>

#include "c_api/owned.h"

namespace {

std::atomic<long> until_failure{-1};  // −1: never

void* allocate(std::size_t size, std::size_t alignment = alignof(std::max_align_t)) {
  if (until_failure.load() >= 0 && until_failure.fetch_sub(1) == 0) throw std::bad_alloc();
  void* place = std::aligned_alloc(alignment, (std::max(size, std::size_t{1}) + alignment - 1) / alignment * alignment);
  if (place == nullptr) throw std::bad_alloc();
  return place;
}

// Not inline: GCC compares each free with the operator new that it sees.
[[gnu::noinline]] void release(void* place) noexcept { std::free(place); }

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return allocate(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* place) noexcept { release(place); }
void operator delete(void* place, std::size_t) noexcept { release(place); }
void operator delete(void* place, std::align_val_t) noexcept { release(place); }
void operator delete(void* place, std::size_t, std::align_val_t) noexcept { release(place); }

namespace patchproof::test {
namespace {

// Calls until nothing fails any more; says how often it did.
long fail_everywhere(const std::function<patchproof_status()>& call) {
  for (long n = 0; n < 1000000; n += 1 + n / 256) {
    until_failure = n;
    const patchproof_status status = call();
    const bool failed = until_failure.exchange(-1) < 0;
    EXPECT_EQ(status, failed ? PATCHPROOF_OUT_OF_MEMORY : PATCHPROOF_OK) << n;
    if (!failed || status == PATCHPROOF_OK) return n;
  }
  ADD_FAILURE() << "it never succeeds";
  return 0;
}

TEST(CApiMemory, EveryFailureIsAStatus) {
  patchproof_context* raw = nullptr;
  until_failure = 0;
  EXPECT_EQ(patchproof_context_create(0, &raw), PATCHPROOF_OUT_OF_MEMORY);
  until_failure = -1;
  const Owned<patchproof_context> context = make_context();
  patchproof_context* c = context.get();
  TwoSquares squares(0.25);
  patchproof_model *model = nullptr, *finer = nullptr;
  EXPECT_GT(fail_everywhere([&] { return patchproof_model_create(c, &squares.data, &model); }), 20);
  const Owned<patchproof_model> owned_model(model);
  const patchproof_text knot = patchproof_from("1/3");
  EXPECT_GT(fail_everywhere([&] { return patchproof_model_patch_insert_knots(c, model, 0, 0, &knot, 1, &finer); }), 3);
  const Owned<patchproof_model> owned_finer(finer);
  patchproof_surface* surface = nullptr;
  EXPECT_GT(fail_everywhere([&] { return patchproof_surface_of(c, model, 0, &surface); }), 3);
  const Owned<patchproof_surface> owned_surface(surface);
  patchproof_certify_options options = sized<patchproof_certify_options>();
  options.jobs = 1;
  patchproof_report* report = nullptr;
  EXPECT_GT(fail_everywhere([&] { return patchproof_certify(c, model, &options, nullptr, &report); }), 20);
  const Owned<patchproof_report> owned_report(report);
  std::vector<char> buffer(1 << 16);
  std::size_t needed = 0;
  EXPECT_GT(fail_everywhere([&] {
              return patchproof_report_write(c, report, PATCHPROOF_REPORT_TABLE, buffer.data(), buffer.size(), &needed);
            }),
            3);
  patchproof_tessellate_options coarse = sized<patchproof_tessellate_options>();
  coarse.chord = 0.5;
  coarse.jobs = 1;
  patchproof_mesh* mesh = nullptr;
  EXPECT_GT(fail_everywhere([&] { return patchproof_tessellate(c, model, &coarse, nullptr, &mesh); }), 20);
  const Owned<patchproof_mesh> owned_mesh(mesh);
  for (const std::int32_t format :
       {PATCHPROOF_MESH_STL, PATCHPROOF_MESH_OBJ, PATCHPROOF_MESH_PLY, PATCHPROOF_MESH_VTU}) {
    std::vector<char> bytes(1 << 20);
    EXPECT_GT(
        fail_everywhere([&] { return patchproof_mesh_write(c, mesh, format, bytes.data(), bytes.size(), &needed); }),
        0);
  }
  EXPECT_GT(fail_everywhere([&] {
              return patchproof_model_write(c, model, PATCHPROOF_FORMAT_JSON, buffer.data(), buffer.size(), &needed);
            }),
            3);
  const patchproof_text uv[] = {patchproof_from("1/3"), patchproof_from("1/7")};
  EXPECT_GT(fail_everywhere([&] {
              return patchproof_model_patch_evaluate_exact(c, model, 0, uv, 2, nullptr, PATCHPROOF_SCALAR_RATIONAL, 1,
                                                           buffer.data(), buffer.size(), &needed);
            }),
            3);
  const std::string json = bytes_of(example("cylinder_q.json"));
  patchproof_model* read = nullptr;
  EXPECT_GT(fail_everywhere([&] {
              return patchproof_model_read_text(c, text_of(json), patchproof_from("c.json"), PATCHPROOF_DECIMALS_EXACT,
                                                &read);
            }),
            20);
  const Owned<patchproof_model> owned_read(read);
}

}  // namespace
}  // namespace patchproof::test
