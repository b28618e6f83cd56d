#include <nmm/scene/scene.h>

// This file makes the loads of water.
namespace NMM
{
  std::vector<Water>
  Scene::make_water() const
  {
    const WaterParameters &p = scene_parameters.water;
    std::vector<Water>     result;
    if (!p.is_present())
      return result;
    result.push_back(p.make_water(p.table));
    for (const StageParameters &stage : scene_parameters.stages)
      if (!stage.water_table.empty())
        result.push_back(p.make_water(stage.water_table,
                                      "Stages/" + stage.name + "/Water table"));
    return result;
  }


  void
  Scene::add_water(const PhysicalMesh &mesh, ElasticityProblem &problem) const
  {
    for (const Water &water : make_water())
      NMM::add_water(water, mesh, scene_parameters.model.kinematics, problem);
  }


  unsigned int
  Scene::n_conditions_of_a_table() const
  {
    const std::vector<Water> tables = make_water();
    return tables.empty() ? 0
                          : water_conditions(tables.front(),
                                             scene_parameters.model.kinematics)
                              .size();
  }
} // namespace NMM
