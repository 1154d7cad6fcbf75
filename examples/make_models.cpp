// SPDX-License-Identifier: Apache-2.0
// make_models FOLDER: writes every model of examples/ into FOLDER, exactly as it is committed.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "models.h"

int main(int argc, char** argv) {
  using namespace patchproof::examples;
  if (argc != 2) {
    std::cerr << "usage: make_models FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::vector<NamedModel> models{cup()};
  for (auto&& group : {quadrics(), seven_cases()}) models.insert(models.end(), group.begin(), group.end());
  for (const NamedModel& model : models) {
    std::filesystem::create_directories((folder / model.path).parent_path());
    std::ofstream out(folder / model.path, std::ios::binary);
    if (!(out << model.json << std::flush)) {
      std::cerr << "make_models: cannot write " << folder / model.path << '\n';
      return 2;
    }
    std::cout << model.path << '\n';
  }
}
