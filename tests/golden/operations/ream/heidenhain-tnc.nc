0 BEGIN PGM ream MM
1 ; program ream, HEIDENHAIN TNC
2 ; part ream, aluminium, 4 mm thick
3 ; stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000
4 ; origin: axis of the part, Z0 on top of the stock
5 ; pin: D6 H7 [0/+0.012], made to 6.006
6 ; dowel: D6 H7 [0/+0.012], made to 6.006
7 ; drills go 2.04 mm below the stock: leave room under the holes
8 ; reamers go 1.20 mm below the stock: leave room under the holes
9 ; origin preset 1, Z0 on top of the stock, units mm and mm/min
10 ; T1 D 6 mm: spot-6, spot drill
11 ; T92 D 5.8 mm: drill-5.8, drill
12 ; T91 D 6 mm: reamer-6, reamer
13 CYCL DEF 247 DATUM SETTING ~
  Q339=+1 ;DATUM NUMBER
14 CYCL DEF 32.0 TOLERANCE
15 CYCL DEF 32.1 T0.002
16 L Z+0 R0 FMAX M91
17 ; operation: spot drill
18 TOOL CALL 1 Z S3714
19 M3
20 L X-10 Y+0 R0 FMAX
21 L Z+5 R0 FMAX
22 M8
23 L Z+1 R0 FMAX
24 L Z-1.74 F222
25 CYCL DEF 9.0 DWELL TIME
26 CYCL DEF 9.1 DWELL 0.2
27 L Z+5 R0 FMAX
28 L X+10 R0 FMAX
29 L Z+1 R0 FMAX
30 L Z-1.74 F222
31 CYCL DEF 9.0 DWELL TIME
32 CYCL DEF 9.1 DWELL 0.2
33 L Z+5 R0 FMAX
34 M9
35 M5
36 L Z+0 R0 FMAX M91
37 ; operation: drill 5.8
38 TOOL CALL 92 Z S3842
39 M3
40 L X-10 Y+0 R0 FMAX
41 L Z+5 R0 FMAX
42 M8
43 L Z+1 R0 FMAX
44 L Z-6.043 F307
45 L Z+5 R0 FMAX
46 L X+10 R0 FMAX
47 L Z+1 R0 FMAX
48 L Z-6.043 F307
49 L Z+5 R0 FMAX
50 M9
51 M5
52 L Z+0 R0 FMAX M91
53 ; operation: pin: ream
54 TOOL CALL 91 Z S1061
55 M3
56 L X-10 Y+0 R0 FMAX
57 L Z+5 R0 FMAX
58 M8
59 L Z+1 R0 FMAX
60 L Z-5.2 F190
61 L Z+1
62 L Z+5 R0 FMAX
63 ; operation: dowel: ream
64 L X+10 R0 FMAX
65 L Z+1 R0 FMAX
66 L Z-5.2 F190
67 L Z+1
68 L Z+5 R0 FMAX
69 M9
70 M5
71 L Z+0 R0 FMAX M91
72 M30
73 END PGM ream MM
