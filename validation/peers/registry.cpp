// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>

#include <algorithm>

#include "validation/peers/peer.h"

namespace patchproof::peers {
namespace {

std::vector<std::unique_ptr<Peer>>& all() {
  static std::vector<std::unique_ptr<Peer>> peers;
  return peers;
}

}  // namespace

std::vector<const Peer*> registered_peers() {
  std::vector<const Peer*> out;
  for (const auto& p : all()) out.push_back(p.get());
  std::sort(out.begin(), out.end(), [](const Peer* a, const Peer* b) { return a->name() < b->name(); });
  return out;
}

bool register_peer(std::unique_ptr<Peer> peer) {
  all().push_back(std::move(peer));
  return true;
}

Result<const Peer*> load_peer(const std::string& path) {
  void* object = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!object) return Error{ErrorCode::cannot_open, path, dlerror(), ""};
  using Maker = Peer* (*)();
  const auto make = reinterpret_cast<Maker>(dlsym(object, "patchproof_peer"));
  if (!make) return Error{ErrorCode::cannot_open, path, "it has no function patchproof_peer", ""};
  register_peer(std::unique_ptr<Peer>(make()));
  return all().back().get();
}

}  // namespace patchproof::peers
