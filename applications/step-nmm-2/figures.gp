# PREFIX stands for the path and the beginning of the names of all files.
set datafile separator ','
set datafile missing 'nan'
set terminal pngcairo size 1200,620 font 'DejaVu Sans,12'
set output 'PREFIXshapes.png'
set multiplot layout 1,2 title 'Deflected shapes, K = P L^3/(E I) = 0, 2, ..., 10 (paper, Fig. 10)'
set size ratio -1
set xrange [-1:11]
set yrange [-9.5:1.5]
set grid
set xlabel 'x [m]'
set ylabel 'y [m]'
set title '(1) constant direction'
plot 'PREFIXshapes-dead.csv' skip 1 using 1:2 with lines lw 1.5 lc 'blue' notitle
set title '(2) follower'
plot 'PREFIXshapes-follower.csv' skip 1 using 1:2 with lines lw 1.5 lc 'dark-red' notitle
unset multiplot
set size noratio
set autoscale
set output 'PREFIXcurves.png'
set multiplot layout 1,2 title 'Displacement of the middle of the end (paper, Fig. 10)'
set xlabel 'K'
set ylabel 'w/L, u/L'
set xrange [0:10]
set yrange [0:0.9]
set key top left
do for [load in 'dead follower'] {
  set title load.' load'
  r = 'PREFIXreference.csv'
  of(value) = strcol(1) eq load ? value : NaN
  t = 'PREFIXtip-'.load.'.csv'
  plot r using 2:(of($3)) with lines lw 3 lc 'gray70' title 'Euler', \
       r using 2:(of($4)) with lines lw 3 lc 'gray70' notitle, \
       r using 2:(of($6)) with lines dt 2 lc 'black' title 'Reissner', \
       r using 2:(of($7)) with lines dt 2 lc 'black' notitle, \
       r using 2:(of($8)) with points pt 6 ps 1.5 lc 'dark-red' title 'solid, fitted (GetFEM)', \
       r using 2:(of($9)) with points pt 6 ps 1.5 lc 'dark-red' notitle, \
       t skip 1 using 1:2 with lines lw 1.5 lc 'blue' title 'manifold method, w/L', \
       t skip 1 using 1:3 with lines lw 1.5 lc 'skyblue' title 'manifold method, u/L'
}
unset multiplot
set terminal pngcairo size 1000,700 font 'DejaVu Sans,12'
set output 'PREFIXerror-against-time.png'
set title 'Error of the deflection against time, five load levels, one core'
set xlabel 'seconds from the curves to the last answer'
set ylabel 'largest relative error of w/L'
set logscale xy
set autoscale
set format '%.0e'
set key top right
f = 'PREFIXstudy.csv'
row(load, kinematics, degree, mesh) = strcol(1) eq load && strcol(2) eq kinematics && $3 == degree && strcol(4) eq mesh ? $9 : NaN
set style data linespoints
plot f skip 1 using 10:(row('dead', 'finite', 1, 'uniform')) pt 5 lc 'orange' title 'finite, p = 1, dead', \
     f skip 1 using 10:(row('dead', 'finite', 2, 'uniform')) pt 7 lc 'skyblue' title 'finite, p = 2, dead', \
     f skip 1 using 10:(row('dead', 'finite', 2, 'graded')) pt 7 lc 'blue' title 'finite, p = 2, refined corners, dead', \
     f skip 1 using 10:(row('follower', 'finite', 2, 'graded')) pt 6 dt 2 lc 'blue' title 'the same, follower', \
     f skip 1 using 10:(row('dead', 'incremental', 2, 'graded')) pt 9 lc 'dark-red' title 'incremental, dead', \
     f skip 1 using 10:(row('follower', 'incremental', 2, 'graded')) pt 8 dt 2 lc 'dark-red' title 'incremental, follower'
