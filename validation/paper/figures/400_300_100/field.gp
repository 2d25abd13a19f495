# The field at the middle of 400_300_100. Redraw: gnuplot -d field.gp
set terminal svg size 1000,284 dynamic noenhanced font 'sans-serif,14' background '#ffffff'
set output 'field.svg'
set encoding utf8
set datafile separator ','
set datafile columnheaders
set key noautotitle
set border 3 lc rgb '#8a8f98' lw 1
set tics nomirror out scale 0.5 font ',12' textcolor rgb '#3c4149'
set xtics offset 0,0.3
set grid xtics ytics back lc rgb '#e6e8eb' lw 1 dt solid
set key outside top left horizontal Left reverse width 1 samplen 1.6 spacing 1.15 textcolor rgb '#3c4149'
set lmargin 11
set rmargin 3
set tmargin 2
set style line 1 lc rgb '#31688e' lw 1.2
set style line 2 lc rgb '#c2571a' lw 1.4
set style line 3 lc rgb '#35a37a' lw 1.2
set style line 4 lc rgb '#8a8f98' lw 1.0
set style fill solid 1.0 noborder
set palette defined (0 '#440154', 1 '#482878', 2 '#3e4989', 3 '#31688e', 4 '#26828e', 5 '#1f9e89', 6 '#35b779', 7 '#6ece58', 8 '#b5de2b', 9 '#fde725')
set label 99 '400_300_100: coupled, dt 0.05 s, seed 1  gem 0.1.0 (4e93e10c64dd)' at screen 0.995, graph 1.0 right offset 0,0.9 font ',9' textcolor rgb '#9aa0a8' noenhanced front
set size ratio -1
set lmargin 8
set rmargin 1
set border 15
unset grid
set label 1 't = 1200 s' at graph 0, graph 1 offset 0,0.8 front
set xlabel 'x [m]' offset 0,0.4
set ylabel 'y [m]' offset 1,0
set xrange [-1615.7:342.20]
set yrange [-235.55:238.49]
set cbrange [0:1.20]
set cblabel 'speed [m/s]' offset -0.5,0
set colorbox noborder
set object 1 rectangle from graph 0,0 to graph 1,1 behind fillcolor rgb '#eef2f5' fillstyle solid noborder
plot 'field_fixed.csv' using 1:2 with filledcurves closed fillcolor rgb '#b9bec6', \
  'field.csv' using 1:2:3 with filledcurves closed fillcolor palette, \
  'field_platform.csv' using 1:2 with filledcurves closed fillcolor rgb '#c2571a'
