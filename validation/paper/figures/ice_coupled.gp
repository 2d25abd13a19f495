# Distance of the ice of runs that differ by the place of one floe, coupled contacts: the middle pair and eight of ten. Redraw: gnuplot -d ice_coupled.gp
set terminal svg size 1000,420 dynamic noenhanced font 'sans-serif,14' background '#ffffff'
set output 'ice_coupled.svg'
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
set label 99 '004_400_25: coupled, seeds 1 to 5  gem e51d90b5108a' at screen 0.995, graph 1.0 right offset 0,0.9 font ',9' textcolor rgb '#9aa0a8' noenhanced front
set key outside bottom left horizontal
set logscale y
set format y '10^{%L}'
set termoption enhanced
set xlabel 'time [min]' offset 0,0.4
set xrange [0:22.1]
set ylabel 'distance of the ice, rms [m]'
set arrow 1 from graph 0, first 0.01 to graph 1, first 0.01 nohead lc rgb '#3c4149' dt (6,4) front
set label 1 'parted' at graph 0.01, first 0.01 offset 0,0.6 textcolor rgb '#3c4149' front
plot 'ice_coupled_1e-09.csv' using 1:3:4 with filledcurves linestyle 1 fs transparent solid 0.12, 'ice_coupled_1e-07.csv' using 1:3:4 with filledcurves linestyle 2 fs transparent solid 0.12, 'ice_coupled_1e-05.csv' using 1:3:4 with filledcurves linestyle 3 fs transparent solid 0.12, 'ice_coupled_0.001.csv' using 1:3:4 with filledcurves linestyle 4 fs transparent solid 0.12, 'ice_coupled_1e-09.csv' using 1:2 with lines linestyle 1 lw 2 title 'moved by 1e-09 m (5 pairs)', 'ice_coupled_1e-07.csv' using 1:2 with lines linestyle 2 lw 2 title 'moved by 1e-07 m (5 pairs)', 'ice_coupled_1e-05.csv' using 1:2 with lines linestyle 3 lw 2 title 'moved by 1e-05 m (5 pairs)', 'ice_coupled_0.001.csv' using 1:2 with lines linestyle 4 lw 2 title 'moved by 0.001 m (5 pairs)'
