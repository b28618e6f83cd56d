#ifndef step_nmm_1_parameters_h
#define step_nmm_1_parameters_h

#include <nmm/covers/aggregation.h>
#include <nmm/materials/material.h>

#include "tutorial/table.h"
#include "tutorial/tutorial.h"
#include <vector>

namespace StepNMM1
{
  using dealii::Patterns::Double;

  struct Parameters : Tutorial::ParameterFile
  {
    using ParameterFile::ParameterFile;

    /// How much of the ring is modelled; there is symmetry on the cuts.
    std::string ring =
      get<std::string>("Ring",
                       "quarter",
                       dealii::Patterns::Selection("quarter|half|full"));
    /// [m]
    double inner_radius = get("Inner radius", 1., positive);
    double outer_radius = get("Outer radius", 2., positive);
    /// Inside [Pa].
    double        pressure = get("Pressure", 1.);
    NMM::Material material = {"ring",
                              get("Young's modulus", 1000., positive),
                              get("Poisson's ratio", 0.25, Double(-1., 0.5))};

    /// Edge lengths of the triangles [m].
    std::vector<double> cell_sizes =
      get<std::vector<double>>("Cell sizes",
                               {0.23, 0.12, 0.0603, 0.0301, 0.01505, 0.0076},
                               positive_list);
    /// Width of the zone of smaller triangles at the inner circle [m].
    double refined_width = get("Refined width", 0.3, positive);
    /// Where the mesh lies against the ring.
    Tutorial::Placement placement = {get("Offset",
                                         dealii::Tensor<1, 2>({0.003, 0.002})),
                                     get("Rotation", 7.)};
    /// Least support that makes an element good [-].
    double aggregation_threshold = get("Aggregation threshold",
                                       NMM::default_aggregation_threshold,
                                       Double(0., 1.));

    /// Random placements, and the edge length of their triangles [m].
    unsigned int n_placements =
      get("Placements", 10u, dealii::Patterns::Integer(0));
    unsigned int seed          = get("Seed", 1u, dealii::Patterns::Integer(0));
    double placement_cell_size = get("Placement cell size", 0.0575, positive);
  };
} // namespace StepNMM1

#endif
