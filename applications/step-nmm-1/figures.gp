# PREFIX stands for the path and the beginning of the names of all files.
set datafile separator ','
set terminal pngcairo size 1000,750 font 'DejaVu Sans,13'
set grid
set output 'PREFIXhoop.png'
set title 'Hoop stress along the radius (paper, Fig. 7)'
set xlabel 'r [m]'
set ylabel 'hoop stress [Pa]'
p1 = 'PREFIXhoop-1.csv'
p2 = 'PREFIXhoop-2.csv'
plot p2 skip 1 using 1:2 with lines lw 4 lc 'gray70' title 'exact', \
     p1 skip 1 using 1:3 with lines dt 2 lc 'black' title 'p = 1, coarsest mesh, direct', \
     p2 skip 1 using 1:3 with points pt 6 lc 'dark-red' title 'p = 2, coarsest mesh, direct', \
     p2 skip 1 using 1:4 with lines lw 2 lc 'blue' title 'p = 2, coarsest mesh, recovered'
set logscale xy
set format '%.0e'
set key bottom left
set output 'PREFIXerror-against-time.png'
set title 'Error against time from the curves to the solution, one core'
set xlabel 'seconds'
set ylabel 'relative L2 error'
f = 'PREFIXstudy.csv'
set style data linespoints
plot f skip 1 using 11:(strcol(1) eq 'uniform' && $2 == 1 ? $5 : NaN) pt 7 lc 'skyblue' title 'displacement, manifold, p = 1', \
     f skip 1 using 11:(strcol(1) eq 'graded' ? $5 : NaN) pt 7 lc 'blue' title 'displacement, manifold, p = 2, refined inside', \
     f skip 1 using 11:(strcol(1) eq 'fitted' ? $5 : NaN) pt 6 dt 2 lc 'blue' title 'displacement, fitted, p = 2 (deal.II)', \
     f skip 1 using 11:(strcol(1) eq 'uniform' && $2 == 1 ? $7 : NaN) pt 5 lc 'orange' title 'stress, manifold, p = 1', \
     f skip 1 using 11:(strcol(1) eq 'graded' ? $7 : NaN) pt 5 lc 'dark-red' title 'stress, manifold, p = 2, refined inside', \
     f skip 1 using 11:(strcol(1) eq 'fitted' ? $7 : NaN) pt 4 dt 2 lc 'dark-red' title 'stress, fitted, p = 2 (deal.II)'
