#include "rejected_input.h"

using namespace rejected_input;

// What a mesh that is distributed among ranks is not for.
namespace
{
  TEST(BadInput, DistributedMeshes)
  {
    const std::vector<std::string> distributed = {
      "Covers/Distribution=distributed"};
    expect_rejected_with({}, "Covers/Distribution=shared", {"shared"});
    const auto rejects = [&](const std::string              &entry,
                             const std::vector<std::string> &words) {
      std::vector<std::string> all = words;
      all.insert(all.end(), {"Distribution", "replicated"});
      expect_rejected_with(distributed, entry, all);
    };
    rejects("Model/Kinematics=finite", {"finite kinematics"});
    rejects("Mathematical mesh/Type=graded", {"not of type regular"});
    rejects("Covers/Own meshes=every region", {"meshes of blocks or regions"});
    std::vector<std::string> with_contact = touching;
    with_contact.push_back(distributed[0]);
    expect_rejected_with(with_contact,
                         "Model/Kinematics=small",
                         {"contact", "Distribution", "replicated"});
  }
} // namespace
