# PREFIX stands for the path and the beginning of the names of all files.
set datafile separator ','
set terminal pngcairo size 1200,560 font 'DejaVu Sans,12'
set grid
set output 'PREFIXpressure.png'
set multiplot layout 1,2 title 'Contact pressure of a cylinder, half-width 0.1 R, augmented Lagrangian'
f = 'PREFIXpressure.csv'
pick(value, springs, ratio) = strcol(3) eq springs && abs($4 - 0.1) < 1e-9 && abs($5 - ratio) < 1e-9 ? value : NaN
set xlabel 'x / b'
set ylabel 'p / p0'
set xrange [0:1.2]
set yrange [0:1.1]
set samples 2000
set key bottom left
plot (x < 1 ? sqrt(1 - x*x) : 0) with lines lw 2 lc 'gray60' title 'Hertz', \
     f skip 1 using 1:(pick($2, 'augmented', 0.2)) with points pt 6 ps 0.8 lc 'orange' title 'edges 0.2 b', \
     f skip 1 using 1:(pick($2, 'augmented', 0.1)) with points pt 7 ps 0.4 lc 'blue' title 'edges 0.1 b'
set ylabel '(p - p of Hertz) / p0'
set yrange [-0.06:0.06]
set key bottom left
plot f skip 1 using 1:(pick($6, 'penalty', 0.1)) with points pt 8 ps 0.6 lc 'dark-red' title 'penalty, edges 0.1 b', \
     f skip 1 using 1:(pick($6, 'augmented', 0.2)) with points pt 6 ps 0.8 lc 'orange' title 'augmented, 0.2 b', \
     f skip 1 using 1:(pick($6, 'augmented', 0.1)) with points pt 7 ps 0.4 lc 'blue' title 'augmented, 0.1 b'
unset multiplot
set autoscale
set output 'PREFIXforce.png'
set multiplot layout 1,2 title 'Force against approach, rigid plates, neo-Hookean'
set xlabel 'approach / R'
set ylabel 'F / (E R)'
set xrange [0:0.4]
set yrange [0:*]
set key top left
g = 'PREFIXforces.csv'
plot 'PREFIXhertz-forces.csv' skip 1 using 1:2 with lines dt 2 lc 'black' title 'Hertz', \
     'PREFIXreference.csv' using 2:(strcol(1) eq 'neo_hookean' ? $3 : NaN) with points pt 6 ps 1.5 lc 'dark-red' title 'GetFEM', \
     g skip 1 using 1:2 with lines lw 1.5 lc 'blue' title 'manifold method', \
     'PREFIXpress-forces.csv' skip 1 using 1:2 with points pt 2 lc 'dark-green' title 'whole cylinder, plates of 1000 E'
set xlabel 'seconds, 20 load steps'
set ylabel 'largest error of the force from 0.2 R on'
set logscale y
set xrange [0:*]
set yrange [1e-5:1e-2]
set format y '%.0e'
set key top right
c = 'PREFIXcompression.csv'
plot c skip 1 using 6:(strcol(1) eq 'penalty' ? $7 : NaN) with linespoints pt 8 lc 'dark-red' title 'penalty', \
     c skip 1 using 6:(strcol(1) eq 'augmented' ? $7 : NaN) with linespoints pt 7 lc 'blue' title 'augmented'
unset multiplot
unset logscale
set format
set terminal pngcairo size 1000,640 font 'DejaVu Sans,12'
set output 'PREFIXstages.png'
set title 'Contact pressure at four stages against Hertz at the same force (paper, Fig. 9)'
set xlabel 'x [m]'
set ylabel 'pressure [kPa]'
set autoscale
set yrange [0:*]
set key top left
array stage[4] = ['0.1 m', '0.2 m', '0.3 m', '0.4 m']
array colour[4] = ['orange', 'dark-green', 'blue', 'dark-red']
plot for [i=1:4] 'PREFIXstages-hertz.csv' skip 1 index i-1 using 1:($2/1000) with lines lw 1 lc rgb colour[i] notitle, \
     for [i=1:4] 'PREFIXpenalty-stages.csv' skip 1 index i-1 using 1:($2/1000) with points pt 6 ps 0.4 lc 'gray60' notitle, \
     for [i=1:4] 'PREFIXaugmented-stages.csv' skip 1 index i-1 using 1:($2/1000) with points pt 7 ps 0.4 lc rgb colour[i] title stage[i], \
     NaN with lines lc 'gray30' title 'Hertz', \
     NaN with points pt 6 ps 0.6 lc 'gray60' title 'springs of 200,000 t/m'
set terminal pngcairo size 1200,1000 font 'DejaVu Sans,12'
set output 'PREFIXshapes.png'
set multiplot layout 2,2 title 'The cylinder between its plates (paper, Fig. 8)'
set size ratio -1
set xrange [-1.4:1.4]
set yrange [-1.45:1.35]
set xlabel 'x [m]'
set ylabel 'y [m]'
unset key
do for [i=1:4] {
  set title 'top plate down by '.stage[i]
  plot sprintf('PREFIXstage-%d-lines.csv', i) skip 1 using 1:2 with lines lc 'gray60', \
       sprintf('PREFIXstage-%d-outlines.csv', i) skip 1 using 1:2 with lines lw 1.5 lc 'blue'
}
unset multiplot
