#ifndef nmm_output_output_h
#define nmm_output_output_h

#include <nmm/output/animation.h>
#include <nmm/output/contact_output.h>
#include <nmm/output/csv_series.h>
#include <nmm/output/picture.h>
#include <nmm/output/vtu.h>

/**
 * @file
 * The room `output`: it writes results to files. It knows fields, contact and tables, but
 * no scene.
 *
 * What comes in: a DisplacementField and its StressRecovery, the Contact, rows of
 * numbers. What goes out: fields and contact points for ParaView (vtu.h,
 * contact_output.h), tables (csv_series.h, probes.h), pictures and an animation
 * (picture.h, animation.h), and messages (progress.h).
 *
 * Order of calls: clear the folder (OutputDirectory); evaluate the fields at the nodes
 * of triangles once (FieldEvaluator, FieldTriangles); pass these to the writers. Each
 * file appears under its name only when it is complete. A file that cannot be written leads to an
 * OutputFailure.
 *
 * @code
 *   const OutputDirectory directory("results");
 *   directory.create();
 *   FileSeries series(directory, "fields");
 *   const FieldEvaluator evaluator(field, recovery, problem);
 *   const FieldTriangles triangles(covers, &evaluator);
 *   series.add(t, write_fields_of_state(covers, triangles, directory, "fields-1"));
 *   PictureParameters parameters;
 *   parameters.quantity = Quantity::displacement;
 *   draw_picture(make_picture_data(covers, triangles, &evaluator, parameters),
 *                parameters, "A beam", "results/picture.png");
 * @endcode
 */

#endif
