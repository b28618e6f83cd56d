#include <nmm/base/exceptions.h>
#include <nmm/covers/weight_functions.h>
#include <nmm/output/picture.h>

#include <deal.II/base/mpi.h>

namespace NMM
{
  void
  draw_scalar_picture(const CoverSystem            &covers,
                      const dealii::Vector<double> &unknowns,
                      const std::string            &quantity,
                      const std::string            &title,
                      const std::string            &file_name)
  {
    AssertDimension(unknowns.size(), covers.n_covers());
    const ManifoldMesh     &mesh  = covers.manifold_mesh();
    const MathematicalMesh &cells = mesh.mathematical_mesh();
    // The only number of a sample that is drawn as it is.
    PictureParameters parameters;
    parameters.quantity = Quantity::plastic_strain;
    FieldTriangles triangles(covers, nullptr);
    for (std::size_t t = 0; t < triangles.nodes.size(); ++t)
    {
      const unsigned int element        = triangles.elements[t];
      const auto         element_covers = covers.covers(element);
      for (unsigned int n = 0; n < 6; ++n)
      {
        double w[WeightFunctions::max_per_cell];
        WeightFunctions::values(cells.degree(),
                                cells.real_to_reference(mesh.cell(element),
                                                        triangles.nodes[t][n]),
                                w);
        double &value = triangles.samples[t][n].plastic_strain;
        for (unsigned int k = 0; k < element_covers.size(); ++k)
          value += w[k] * unknowns(element_covers[k]);
      }
    }
    const PictureData data =
      make_picture_data(covers, triangles, nullptr, parameters);
    PictureFrame frame;
    frame.quantity = quantity;
    if (dealii::Utilities::MPI::this_mpi_process(covers.communicator()) == 0)
      draw_picture(data, parameters, title, file_name, frame);
  }
} // namespace NMM
