#include "rejected_input.h"

using namespace rejected_input;

// Crack tips and what is computed of them.
namespace
{
  const std::vector<std::string> cracked = {
    "Geometry/Text=" + square +
      "; joint name=crack LINESTRING (0 0.5, 0.5 0.5)",
    "Fracture/Intensity factors=true"};


  TEST(BadInput, Fracture)
  {
    const auto rejects = [](const std::string              &entry,
                            const std::vector<std::string> &words) {
      expect_rejected_with(cracked, entry, words);
    };
    rejects("Fracture/Radius=0.6",
            {"0.6", "(0.5, 0.5)", "Fracture/Radius", "at most 0.5"});
    rejects("Fracture/Grading=0", {"'Grading'", "0", "(0, 1]"});
    rejects("Fracture/Grading=2", {"Grading", "2"});
    rejects("Fracture/Tips=sharp", {"sharp", "graded", "as meshed"});
    expect_rejected_with(
      cracked +
        std::vector<std::string>{"Model/Kinematics=finite",
                                 "Boundary conditions/Names=held, faces",
                                 "Boundary conditions/faces/Boundary=crack",
                                 "Boundary conditions/faces/Value=1"},
      "Boundary conditions/faces/Type=pressure",
      {"faces", "follower pressure"});
    expect_rejected_with(
      cracked +
        std::vector<std::string>{"Relaxation/Step=0.1",
                                 "Materials/rock/Density=1",
                                 "Contact/Enforcement=penalty",
                                 "Contact/Friction angle=30",
                                 "Safety factor/Largest displacement=0.1"},
      "Model/Analysis=safety factor",
      {"intensity factors", "safety factor", "dynamic or relaxation"});
    expect_rejected_with(
      cracked + std::vector<std::string>{"Model/Plane state=plane strain",
                                         "Materials/rock/Cohesion=1"},
      "Materials/rock/Law=Mohr-Coulomb",
      {"intensity factors", "yield", "elastic"});
    rejects("Geometry/Text=" + square, {"no crack tip", "open joint"});
    rejects("Geometry/Text=" + square +
              "; joint state=closed LINESTRING (0 0.5, 0.5 0.5)",
            {"no crack tip", "open joint"});
    expect_rejected_override("Fracture/Radius=0.1",
                             {"'Radius'", "Intensity factors = true"});
    expect_rejected_override("Fracture/Grading=0.1",
                             {"'Grading'", "Tips = graded"});
  }


  TEST(BadInput, CrackGrowth)
  {
    const std::vector<std::string> growing =
      cracked + std::vector<std::string>{"Fracture/Increments=2",
                                         "Fracture/Increment=0.1",
                                         "Materials/rock/Toughness=1"};
    const auto rejects = [&](const std::string              &entry,
                             const std::vector<std::string> &words) {
      expect_rejected_with(growing, entry, words);
    };
    rejects("Fracture/Increment=0", {"0 m", "Fracture/Increment"});
    rejects("Fracture/Increment=-1", {"Increment", "-1"});
    rejects("Fracture/Increments=-1", {"Increments", "-1"});
    rejects("Fracture/Criterion=luck", {"luck", "hoop stress"});
    rejects("Materials/rock/Toughness=0", {"toughness", "rock", "Toughness"});
    rejects("Materials/rock/Initial stress=1, 0, 0",
            {"initial stress", "Initial stress"});
    rejects("Fracture/Intensity factors=false",
            {"intensity factors", "Fracture/Intensity factors = true"});
    // In motion.
    const std::vector<std::string> moving =
      growing + std::vector<std::string>{"Model/Analysis=dynamic",
                                         "Time/End time=1",
                                         "Time/Initial step=0.1",
                                         "Materials/rock/Density=1"};
    rejects("Fracture/Speed=100", {"Speed", "Model/Analysis = dynamic"});
    expect_rejected_with(cracked,
                         "Fracture/Speed=100",
                         {"'Speed'", "Increments"});
    expect_rejected_with(
      moving +
        std::vector<std::string>{"Model/Kinematics=finite",
                                 "Boundary conditions/Names=held, faces",
                                 "Boundary conditions/faces/Boundary=crack",
                                 "Boundary conditions/faces/Value=1"},
      "Boundary conditions/faces/Type=pressure",
      {"faces", "follower pressure"});
    expect_rejected_with(
      growing + std::vector<std::string>{"Contact/Enforcement=penalty"},
      "Load steps/Load factors=1, 0.5",
      {"load factor", "Load steps/Load factors", "ascend"});
    expect_rejected_with(cracked,
                         "Fracture/Increment=0.1",
                         {"'Increment'", "Increments"});
    expect_rejected_with(cracked,
                         "Fracture/Criterion=local symmetry",
                         {"'Criterion'", "Increments"});
  }


  // A pressure needs faces, which a joint has that is open.
  TEST(BadInput, PressureInJoints)
  {
    const auto crack = [](const std::string &state, const std::string &type) {
      return std::vector<std::string>{
        "Geometry/Text=" + square + "; joint name=crack state=" + state +
          " LINESTRING (0 0.5, 0.5 0.5)",
        "Boundary conditions/Names=held, crack",
        "Boundary conditions/crack/Boundary=crack",
        "Boundary conditions/crack/Type=" + type};
    };
    expect_rejected_with(crack("closed", "pressure"),
                         "Boundary conditions/crack/Value=1",
                         {"crack", "closed", "state=open"});
    expect_rejected_with(crack("open", "traction"),
                         "Boundary conditions/crack/Value=1; 0",
                         {"crack", "no boundary", "pressure"});
  }
} // namespace
