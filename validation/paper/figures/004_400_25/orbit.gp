# Orbit of the platform. Redraw: gnuplot -d orbit.gp
set terminal svg size 1000,610 dynamic noenhanced font 'sans-serif,14' background '#ffffff'
set output 'orbit.svg'
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
set label 99 '004_400_25: coupled, dt 0.2 s, seed 1  gem 0.1.0 (4e93e10c64dd)' at screen 0.995, graph 1.0 right offset 0,0.9 font ',9' textcolor rgb '#9aa0a8' noenhanced front
set size ratio -1
set border 15
set xlabel 'x [mm]' offset 0,0.4
set ylabel 'y [mm]'
set cblabel 'time [h]'
set cbrange [0:2.00000]
set colorbox noborder
set rmargin 1
set xrange [-53.401:69.525]
set yrange [-42.769:42.008]
set object 1 circle at 0,0 size graph 0.004 fillcolor rgb '#1f2530' fillstyle solid noborder front
plot 'orbit.csv' using 1:2:3 with lines linewidth 1 linecolor palette
