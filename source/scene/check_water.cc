#include <nmm/base/exceptions.h>
#include <nmm/scene/scene_parameters.h>

#include <algorithm>

// This file checks that water fits the rest of the scene.
namespace NMM
{
  void
  SceneParameters::check_water() const
  {
    water.check();
    for (const Material &material : materials)
      AssertThrow(!material.wet_density || !water.table.empty(),
                  InputError("there is no water table below which the wet "
                             "density counts",
                             "parameter 'Materials/" + material.name +
                               "/Wet density'",
                             "set 'Water/Table', or remove it"));
    for (const StageParameters &stage : stages)
      if (!stage.water_table.empty())
      {
        const std::string where =
          "parameter 'Stages/" + stage.name + "/Water table'";
        AssertThrow(!water.table.empty(),
                    InputError("a stage moves a water table that is not there",
                               where,
                               "set 'Water/Table'"));
        AssertThrow(!water.fills_pores &&
                      std::none_of(materials.begin(),
                                   materials.end(),
                                   [](const Material &material) {
                                     return material.wet_density.has_value();
                                   }),
                    InputError("the table moves, which is not built for water "
                               "in pores and wet densities",
                               where,
                               "remove it, or 'Water/Pores' and 'Wet density' "
                               "of materials"));
      }
  }
} // namespace NMM
