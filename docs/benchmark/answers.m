% A method outside, for MATLAB and Octave: the straight line x = a + b Y through each case.
% usage: octave answers.m EXPORT ANSWERS.csv
arguments_ = argv();
folder = arguments_{end - 1};
constants = dlmread(fullfile(folder, 'constants.csv'), ',', 1, 0);
out = fopen(arguments_{end}, 'w');
fprintf(out, 'case,zeta,F0,zeta_low,zeta_high,F0_low,F0_high\n');
for i = 1:size(constants, 1)
  pairs = dlmread(fullfile(folder, 'cases', sprintf('%06d.csv', constants(i, 1))), ',', 1, 0);
  if size(pairs, 1) < 3
    continue  % too little could be measured: no answer
  end
  Y = pairs(:, 1);
  x = pairs(:, 2);
  n = numel(Y);
  S = sum((Y - mean(Y)) .^ 2);
  b = sum((Y - mean(Y)) .* (x - mean(x))) / S;
  a = mean(x) - b * mean(Y);
  deviation = sqrt(sum((x - a - b * Y) .^ 2) / (n - 2));
  zeta = 1 / (2 * b);  % at resonance x = (Y - (4/pi) F0/k)/(2 zeta), to first order in zeta
  F0 = -a / b * pi / 4 * constants(i, 3);
  spread = 2 * deviation * [zeta / sqrt(S) / b, F0 * sqrt(1 / n + mean(Y) ^ 2 / S) / -a];
  fprintf(out, '%d,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n', constants(i, 1), zeta, F0, ...
          zeta - abs(spread(1)), zeta + abs(spread(1)), F0 - abs(spread(2)), F0 + abs(spread(2)));
end
fclose(out);
