# PREFIX stands for the path and the beginning of the names of all files.
set datafile separator ','
set terminal pngcairo size 1250,750 font 'DejaVu Sans,13'
set grid
set logscale xy
set format '%.0e'
set key outside right top
set output 'PREFIXerrors.png'
set title 'A crack tip anywhere in the mesh: error against time, one core'
set xlabel 'seconds'
set ylabel 'relative error'
f = 'PREFIXstudy.csv'
set style data linespoints
row(mesh, degree, column) = strcol(1) eq mesh && $2 == degree ? column : NaN
plot f skip 1 using 7:(row('covered', 2, $4)) pt 5 lc 'dark-green' title 'K, second order, cover of the tip', \
     f skip 1 using 7:(row('graded', 2, $4)) pt 7 lc 'blue' title 'K, second order, graded', \
     f skip 1 using 7:(row('graded', 1, $4)) pt 6 lc 'blue' dt 2 title 'K, first order, graded', \
     f skip 1 using 7:(row('uniform', 2, $4)) pt 4 lc 'gray50' title 'K, second order, cells of one size', \
     f skip 1 using 7:(row('covered', 2, $6)) pt 5 lc 'orange-red' title 'stress, second order, cover of the tip', \
     f skip 1 using 7:(row('graded', 2, $6)) pt 7 lc 'dark-red' title 'stress, second order, graded', \
     f skip 1 using 7:(row('graded', 1, $6)) pt 6 lc 'dark-red' dt 2 title 'stress, first order, graded', \
     f skip 1 using 7:(row('uniform', 2, $6)) pt 4 lc 'orange' title 'stress, second order, cells of one size'
unset logscale
set format '%g'
set size ratio -1
set output 'PREFIXpaths.png'
set title 'Paths of the crack from the notch [in]'
set xrange [-7:-3]
set yrange [0:8]
set xlabel 'x [in]'
set ylabel 'y [in]'
set key outside right top
set object 1 circle at -4,2.75 size 0.25 fc 'gray70' fs solid border lc 'black'
set object 2 circle at -4,4.75 size 0.25 fc 'gray70' fs solid border lc 'black'
set object 3 circle at -4,6.75 size 0.25 fc 'gray70' fs solid border lc 'black'
set style data lines
set datafile separator whitespace
plot for [i=0:*] 'PREFIXpaths.txt' index i using 1:2 lw 2 title columnheader(1), \
     '-' using 1:2 lw 3 lc 'black' title 'notch'
-6 0
-6 1
e
