0 BEGIN PGM spot MM
1 ; program spot, HEIDENHAIN TNC
2 ; part spot, aluminium, 4 mm thick
3 ; stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000
4 ; origin: axis of the part, Z0 on top of the stock
5 ; drills go 1.80 mm below the stock: leave room under the holes
6 ; origin preset 1, Z0 on top of the stock, units mm and mm/min
7 ; T1 D 6 mm: spot-6, spot drill
8 ; T7 D 5 mm: drill-5, drill
9 CYCL DEF 247 DATUM SETTING ~
  Q339=+1 ;DATUM NUMBER
10 CYCL DEF 32.0 TOLERANCE
11 CYCL DEF 32.1 T0.002
12 L Z+0 R0 FMAX M91
13 ; operation: spot drill
14 TOOL CALL 1 Z S3714
15 M3
16 L X-10 Y+5 R0 FMAX
17 L Z+5 R0 FMAX
18 M8
19 L Z+1 R0 FMAX
20 L Z-1.5 F222
21 CYCL DEF 9.0 DWELL TIME
22 CYCL DEF 9.1 DWELL 0.2
23 L Z+5 R0 FMAX
24 L X+10 Y-5 R0 FMAX
25 L Z+1 R0 FMAX
26 L Z-1.5 F222
27 CYCL DEF 9.0 DWELL TIME
28 CYCL DEF 9.1 DWELL 0.2
29 L Z+5 R0 FMAX
30 M9
31 M5
32 L Z+0 R0 FMAX M91
33 ; operation: drill 5
34 TOOL CALL 7 Z S5093
35 M3
36 L X-10 Y+5 R0 FMAX
37 L Z+5 R0 FMAX
38 M8
39 L Z+1 R0 FMAX
40 L Z-5.803 F376
41 L Z+5 R0 FMAX
42 L X+10 Y-5 R0 FMAX
43 L Z+1 R0 FMAX
44 L Z-5.803 F376
45 L Z+5 R0 FMAX
46 M9
47 M5
48 L Z+0 R0 FMAX M91
49 M30
50 END PGM spot MM
